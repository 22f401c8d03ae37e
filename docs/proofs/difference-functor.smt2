; difference(C, C′)∘difference(C′, C″) = difference(C, C″), and the multiplicities add up without a clamp.
; Paper: Def. 4 as Def. 5 uses it.
; Theory: docs/algebra.md, Why the paper's use is sound.
; Code: difference, transition, event_of, delta_of. Tests: event.apply_theorems.difference_is_a_functor.
; This is the step of an induction: whatever the brackets, a run from C₀ to Cₙ composes to difference(C₀, Cₙ). The
; induction itself, over brackets of any size, is in coq/Run.v.

(declare-const c0 Atoms)
(declare-const c1 Atoms)
(declare-const c2 Atoms)

(push)
(assert (distinct c0 c1 c2))
(assert (not (= (intersect (plus (difference c0 c1)) (minus (difference c1 c2))) none)))
(echo "possible: three different sets, an atom coming and going")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (compose (difference c0 c1) (difference c1 c2)) (difference c0 c2))))
(echo "proved: differences compose to the difference")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-const x Atom)
(assert (not (= (+ (value (difference c0 c1) x) (value (difference c1 c2) x)) (value (difference c0 c2) x))))
(echo "proved: their multiplicities add up to those of the difference")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (and (= (difference c0 c0) nothing) (= (difference c1 c0) (inverse (difference c0 c1))))))
(echo "proved: staying is (∅, ∅), going back is the inverse")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-const d Atoms)
(assert (not (= (compose (difference c0 c1) (difference d c2)) (difference c0 c2))))
(echo "refuted: so it is also if the second starts elsewhere")
(set-info :status sat)
(check-sat)
(pop)
