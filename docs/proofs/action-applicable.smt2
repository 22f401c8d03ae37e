; e is applicable at C, that is e⁺ ∩ C = ∅ and e⁻ ⊆ C, iff χ(C) + ι(e) stays within {0, 1}; then χ(e·C) = χ(C) + ι(e).
; Paper: section 4, how allocations change.
; Theory: docs/algebra.md, The action.
; Code: applicable, apply. Tests: event.apply.refuses_iff_it_leaves_the_sets,
; event.apply.characteristic_adds.

(declare-const e Pair)
(declare-const c Atoms)
(assert (is_event e))
(define-fun in_range () Bool (forall ((x Atom)) (and (<= 0 (+ (chi c x) (value e x))) (<= (+ (chi c x) (value e x)) 1))))

(push)
(assert (applicable e c))
(assert (not (= (plus e) none)))
(assert (not (= (minus e) none)))
(assert (not (is_subset c (mentioned e))))
(echo "possible: an event that adds and subtracts, applicable at a set that it does not exhaust")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (applicable e c))
(assert (not in_range))
(echo "proved: if e is applicable, the sum stays within {0, 1}")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert in_range)
(assert (not (applicable e c)))
(echo "proved: if the sum stays within {0, 1}, e is applicable")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-const x Atom)
(assert (applicable e c))
(assert (not (= (chi (apply e c) x) (+ (chi c x) (value e x)))))
(echo "proved: χ(e·C) = χ(C) + ι(e)")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-const x Atom)
(assert (not (= (chi (apply e c) x) (+ (chi c x) (value e x)))))
(echo "refuted: so it is where e is not applicable")
(set-info :status sat)
(check-sat)
(pop)
