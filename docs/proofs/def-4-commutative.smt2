; e∘f = f∘e.
; Paper: Def. 4 (group claim: abelian).
; Theory: docs/algebra.md, Not a group.
; Code: compose. Tests: event.definition_4.commutative.

(declare-const e Pair)
(declare-const f Pair)
(assert (is_event e))
(assert (is_event f))

(push)
(assert (not (= e f)))
(assert (not (= (compose e f) e)))
(assert (not (= (compose e f) f)))
(echo "possible: two different events, neither of which absorbs the other")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (compose e f) (compose f e))))
(echo "proved: e∘f = f∘e")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (compose e f) (compose f (inverse e)))))
(echo "refuted: e∘f = f∘e⁻¹")
(set-info :status sat)
(check-sat)
(pop)
