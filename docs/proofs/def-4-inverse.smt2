; (ϑ⁻, ϑ⁺) is an inverse of (ϑ⁺, ϑ⁻), and the only one.
; Paper: Def. 4 (group claim: inverse).
; Theory: docs/algebra.md, Not a group.
; Code: inverse. Tests: event.definition_4.right_inverse, event.definition_4.unique_inverse.

(declare-const e Pair)
(declare-const f Pair)
(assert (is_event e))
(assert (is_event f))

(push)
(assert (= (compose e f) nothing))
(assert (not (= (plus e) none)))
(assert (not (= (minus e) none)))
(echo "possible: two events with sum (∅, ∅), adding and subtracting")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (and (is_event (inverse e)) (= (compose e (inverse e)) nothing) (= (compose (inverse e) e) nothing))))
(echo "proved: the swapped pair is an event and an inverse")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= (compose e f) nothing))
(assert (not (= f (inverse e))))
(echo "proved: no other event is an inverse")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= (compose e f) f))
(assert (not (= f (inverse e))))
(echo "refuted: only the inverse of e absorbs e")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (compose e e) nothing)))
(echo "refuted: every event is its own inverse")
(set-info :status sat)
(check-sat)
(pop)
