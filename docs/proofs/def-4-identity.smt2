; (∅, ∅) is the identity, and the only one.
; Paper: Def. 4 (group claim: identity).
; Theory: docs/algebra.md, Not a group.
; Code: event::event(), compose. Tests: event.definition_4.left_identity.

(declare-const e Pair)
(declare-const f Pair)
(assert (is_event e))
(assert (is_event f))

(push)
(assert (not (= (plus e) none)))
(assert (not (= (minus e) none)))
(echo "possible: an event that adds and subtracts")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (and (is_event nothing) (= (compose e nothing) e) (= (compose nothing e) e))))
(echo "proved: (∅, ∅) is an event, and e∘(∅, ∅) = (∅, ∅)∘e = e")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (forall ((g Pair)) (=> (is_event g) (= (compose g f) g))))
(assert (not (= f nothing)))
(echo "proved: whoever changes no event is (∅, ∅)")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= (compose e f) e))
(assert (not (= f nothing)))
(echo "refuted: whoever does not change one event is (∅, ∅)")
(set-info :status sat)
(check-sat)
(pop)
