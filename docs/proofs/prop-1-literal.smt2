; Read literally, with no allocation in place of ∅ where an agent does not execute the plan type, Prop. 1 is false: b
; may hold no allocation, and then nobody is in conflict with it. It holds iff b holds one, or ∅ counts as one.
; Paper: Prop. 1 (false as written, needs a reading).
; Theory: docs/algebra.md, Conflict, Proposition 1, cycle.
; Code: proposition_1, whose cb is an allocation. Tests: conflict.proposition_1.witness_is_in_conflict_with_b.

(declare-sort Agent 0)
(declare-fun agent (Atom) Agent)
(declare-fun holds (Agent) Bool)
(declare-fun belief (Agent) Atoms)
(define-fun caused_by ((a Agent) (b Agent) (x Atom)) Bool
  (and (holds a) (holds b) (has (belief a) x) (not (has (belief b) x))))
(define-fun in_conflict ((a Agent) (b Agent)) Bool (and (holds a) (holds b) (not (= (belief a) (belief b)))))

(declare-const a1 Agent)
(declare-const a2 Agent)
(declare-const x Atom)
(define-fun b () Agent (agent x))
(assert (caused_by a1 a2 x))

(push)
(assert (holds b))
(assert (distinct a1 a2 b))
(echo "possible: a cause about a third agent that holds an allocation")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (or (in_conflict a1 b) (in_conflict a2 b))))
(echo "refuted: literally, one of the two is in conflict with b")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (holds b) (or (in_conflict a1 b) (in_conflict a2 b)))))
(echo "proved: literally, one of the two is in conflict with b iff b holds an allocation")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (forall ((a Agent)) (holds a)))
(assert (not (or (in_conflict a1 b) (in_conflict a2 b))))
(echo "proved: if everybody holds one, possibly ∅, one of the two is in conflict with b")
(set-info :status unsat)
(check-sat)
(pop)
