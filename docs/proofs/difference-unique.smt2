; For any C and C′ exactly one event is applicable at C and leads to C′: difference(C, C′) = (C′ ∖ C, C ∖ C′).
; Paper: section 4, how allocations change.
; Theory: docs/algebra.md, The action.
; Code: difference, apply. Tests: event.apply.unique_applicable_event,
; event.apply.unique_applicable_event.

(declare-const c Atoms)
(declare-const d Atoms)
(declare-const e Pair)

(push)
(assert (is_event e))
(assert (applicable e c))
(assert (= (apply e c) d))
(assert (not (= (intersect c d) none)))
(assert (not (is_subset c d)))
(assert (not (is_subset d c)))
(echo "possible: an event between two sets of which neither contains the other")
(set-info :status sat)
(check-sat)
(pop)

(push)
(define-fun it () Pair (difference c d))
(assert (not (and (is_event it) (applicable it c) (= (apply it c) d))))
(echo "proved: the difference is an event, applicable at C, and leads to C′")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (is_event e))
(assert (applicable e c))
(assert (= (apply e c) d))
(assert (not (= e (difference c d))))
(echo "proved: no other event is applicable at C and leads to C′")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (is_event e))
(assert (= (apply e c) d))
(assert (not (= e (difference c d))))
(echo "refuted: it is the only one also among those that are not applicable")
(set-info :status sat)
(check-sat)
(pop)
