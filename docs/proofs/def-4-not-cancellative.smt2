; e∘f = e∘g does not imply f = g; at an event e it does iff e = (∅, ∅).
; Paper: Def. 4 (group claim: what every group has, refuted).
; Theory: docs/algebra.md, Not a group.
; Code: compose. Tests: event.cancellation_fails_at_every_event_but_the_identity.

(declare-const e Pair)
(declare-const f Pair)
(declare-const g Pair)
(assert (is_event e))
(assert (is_event f))
(assert (is_event g))

(push)
(assert (= (compose e f) (compose e g)))
(assert (not (= f nothing)))
(assert (not (= g nothing)))
(echo "possible: two events other than (∅, ∅) that e does not tell apart")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (= (compose e f) (compose e g)))
(assert (not (= f g)))
(echo "refuted: e∘f = e∘g implies f = g")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= e nothing)))
(assert (not (and (= (compose e e) (compose e nothing)) (not (= e nothing)))))
(echo "proved: it fails at every e other than (∅, ∅), with f = e and g = (∅, ∅)")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= e nothing))
(assert (= (compose e f) (compose e g)))
(assert (not (= f g)))
(echo "proved: it holds at (∅, ∅)")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= (intersect (mentioned e) (unite (mentioned f) (mentioned g))) none))
(assert (= (compose e f) (compose e g)))
(assert (not (= f g)))
(echo "proved: it holds where e shares no atom with f and g")
(set-info :status unsat)
(check-sat)
(pop)
