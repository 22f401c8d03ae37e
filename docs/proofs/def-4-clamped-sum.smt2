; The set formula of Def. 4 is, at each atom, the sum clamped into [−1, +1].
; Paper: Def. 4.
; Theory: docs/algebra.md, introduction.
; Code: compose, clamped_sum. Tests: event.compose_is_definition_4_to_the_letter, event.compose_and_inverse_are_pointwise.
; With def-3-sign-functions this lifts statements about three signs to statements about events.

(declare-const e Pair)
(declare-const f Pair)
(declare-const x Atom)
(assert (is_event e))
(assert (is_event f))

(push)
(assert (= (value e x) 1))
(assert (= (value f x) 1))
(echo "possible: two events that add the same atom")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (value (compose e f) x) (clamped_sum (value e x) (value f x)))))
(echo "proved: the value of e∘f is the clamped sum of the values")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (value (inverse e) x) (- (value e x)))))
(echo "proved: the value of the inverse is the negated value")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (value (compose e f) x) (+ (value e x) (value f x)))))
(echo "refuted: the value of e∘f is the sum of the values, without the clamp")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (value (compose e f) x) (value f x))))
(echo "refuted: the later event wins")
(set-info :status sat)
(check-sat)
(pop)
