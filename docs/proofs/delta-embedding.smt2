; Integer multiplicities repair what the clamp breaks. ι embeds events, ρ clamps: ρ(ι e) = e, e∘f = ρ(ι e + ι f). Neither is
; a homomorphism. At one atom; sums are taken atom by atom by definition. The universal property is proved in coq/Delta.v.
; Paper: Def. 4 (repair of the group claim).
; Theory: docs/algebra.md, What is true instead.
; Code: delta, clamp. Tests: delta.abelian_group.associative, delta.group_theorems.cancellative,
; delta.embedding.clamp_retracts_the_embedding, delta.embedding.compose_is_the_clamped_sum,
; delta.neither_embedding_nor_clamp_is_a_homomorphism.

(declare-const e Pair)
(declare-const f Pair)
(declare-const x Atom)
(assert (is_event e))
(assert (is_event f))
(declare-const l Int)
(declare-const m Int)
(declare-const n Int)

(push)
(assert (= (value e x) (value f x) 1))
(assert (and (> l 1) (< m (- 1)) (= n 0)))
(echo "possible: events that add one atom, and multiplicities beyond the signs")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (and (= (+ (+ l m) n) (+ l (+ m n))) (= (+ l m) (+ m l)) (= (+ l 0) l) (= (+ l (- l)) 0))))
(echo "proved: multiplicities form an abelian group")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= (+ l m) (+ l n)))
(assert (not (= m n)))
(echo "proved: multiplicities cancel")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (= (clamped_sum l m) (clamped_sum l n)))
(assert (not (= m n)))
(echo "refuted: multiplicities cancel also where sums saturate")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (clamp (value e x)) (value e x))))
(echo "proved: ρ(ι e) = e")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (value (compose e f) x) (clamp (+ (value e x) (value f x))))))
(echo "proved: e∘f = ρ(ι e + ι f)")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (value (compose e f) x) (+ (value e x) (value f x)))))
(echo "refuted: ι(e∘f) = ι e + ι f")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (= (clamp (+ m n)) (clamped_sum (clamp m) (clamp n)))))
(echo "refuted: ρ(m + n) = ρ(m)∘ρ(n)")
(set-info :status sat)
(check-sat)
(pop)
