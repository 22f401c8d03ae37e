; The composition of two events is an event: no atom is both added and subtracted.
; Paper: Def. 4 (group claim: closure).
; Theory: docs/algebra.md, Not a group.
; Code: compose. Tests: event.definition_4.closed.

(declare-const e Pair)
(declare-const f Pair)

(push)
(assert (is_event e))
(assert (is_event f))
(assert (not (= (intersect (plus e) (minus f)) none)))
(assert (not (= (plus (compose e f)) none)))
(assert (not (= (minus (compose e f)) none)))
(echo "possible: two events that partly cancel")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (is_event e))
(assert (is_event f))
(assert (not (is_event (compose e f))))
(echo "proved: e∘f is an event")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (is_event e))
(assert (not (is_event (compose e f))))
(echo "refuted: e∘f is an event also if f is none")
(set-info :status sat)
(check-sat)
(pop)
