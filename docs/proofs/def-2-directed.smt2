; C₁ conflicts with C₂ iff both are for one plan type and some atom is in C₁ but not in C₂. That is directed. Two agents
; are in conflict iff it holds one way or the other, that is, iff C₁ ≠ C₂ within one plan type.
; Paper: Def. 2.
; Theory: docs/algebra.md, Conflict, Proposition 1, cycle.
; Code: conflicts_with, causes, in_conflict. Tests: conflict.definition_2.conflict_iff_some_cause, conflict.definition_2.never_between_plan_types.

(declare-sort Type 0)
(declare-datatypes ((Allocation 0)) (((allocation (type Type) (atoms Atoms)))))
(define-fun causes ((c Allocation) (d Allocation)) Atoms
  (ite (= (type c) (type d)) (subtract (atoms c) (atoms d)) none))
(define-fun conflicts_with ((c Allocation) (d Allocation)) Bool
  (and (= (type c) (type d)) (not (is_subset (atoms c) (atoms d)))))
(define-fun in_conflict ((c Allocation) (d Allocation)) Bool
  (and (= (type c) (type d)) (not (= (atoms c) (atoms d)))))
(define-fun definition_2 ((c Allocation) (d Allocation)) Bool
  (and (= (type c) (type d)) (exists ((x Atom)) (and (has (atoms c) x) (not (has (atoms d) x))))))

(declare-const c Allocation)
(declare-const d Allocation)

(push)
(assert (conflicts_with c d))
(assert (conflicts_with d c))
(echo "possible: two allocations that conflict both ways")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (conflicts_with c d) (definition_2 c d))))
(echo "proved: conflicts_with is Def. 2")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (conflicts_with c d) (not (= (causes c d) none)))))
(echo "proved: there is a conflict iff there is a cause")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (conflicts_with c d))
(assert (not (conflicts_with d c)))
(echo "refuted: conflict is symmetric")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (in_conflict c d) (or (conflicts_with c d) (conflicts_with d c)))))
(echo "proved: two agents are in conflict iff one allocation conflicts with the other")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (or (conflicts_with c c) (in_conflict c c) (not (= (in_conflict c d) (in_conflict d c)))))
(echo "proved: nobody is in conflict with himself, and being in conflict is symmetric")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (type c) (type d))))
(assert (or (conflicts_with c d) (in_conflict c d)))
(echo "proved: allocations of different plan types never conflict")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= c d)))
(assert (not (in_conflict c d)))
(echo "refuted: different allocations are in conflict, whatever their plan types")
(set-info :status sat)
(check-sat)
(pop)
