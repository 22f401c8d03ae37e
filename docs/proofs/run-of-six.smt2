; Of a run of up to six events every bracketing is the same event: the sum, which needs no clamp.
; Paper: Def. 4 as Def. 5 uses it (repair of the group claim).
; Theory: docs/algebra.md, Why the paper's use is sound.
; Code: compose. Tests: event.run.brackets_do_not_matter, event.run.left_fold_is_the_sum,
; run.of_length_six_is_one_event_in_every_bracketing, run.consecutively_applicable_from_somewhere_iff_signs_alternate.
; At one atom (see def-4-clamped-sum): the events have signs s1 … s6 there, and bij is the value of a bracketing of
; si … sj whose outermost split comes after the event kij. A bracketing of six splits each interval that it uses at one
; place, and no choice excludes another: leaving every k open covers all 42 at once. Shorter runs end in zeros. For runs
; of any length see coq/Run.v.

(declare-const s1 Int) (declare-const s2 Int) (declare-const s3 Int)
(declare-const s4 Int) (declare-const s5 Int) (declare-const s6 Int)
(assert (and (is_sign s1) (is_sign s2) (is_sign s3) (is_sign s4) (is_sign s5) (is_sign s6)))

(declare-const k13 Int) (declare-const k24 Int) (declare-const k35 Int) (declare-const k46 Int)
(declare-const k14 Int) (declare-const k25 Int) (declare-const k36 Int)
(declare-const k15 Int) (declare-const k26 Int) (declare-const k16 Int)
(define-fun o ((s Int) (t Int)) Int (clamped_sum s t))
(define-fun b12 () Int (o s1 s2))
(define-fun b23 () Int (o s2 s3))
(define-fun b34 () Int (o s3 s4))
(define-fun b45 () Int (o s4 s5))
(define-fun b56 () Int (o s5 s6))
(define-fun b13 () Int (ite (= k13 1) (o s1 b23) (o b12 s3)))
(define-fun b24 () Int (ite (= k24 2) (o s2 b34) (o b23 s4)))
(define-fun b35 () Int (ite (= k35 3) (o s3 b45) (o b34 s5)))
(define-fun b46 () Int (ite (= k46 4) (o s4 b56) (o b45 s6)))
(define-fun b14 () Int (ite (= k14 1) (o s1 b24) (ite (= k14 2) (o b12 b34) (o b13 s4))))
(define-fun b25 () Int (ite (= k25 2) (o s2 b35) (ite (= k25 3) (o b23 b45) (o b24 s5))))
(define-fun b36 () Int (ite (= k36 3) (o s3 b46) (ite (= k36 4) (o b34 b56) (o b35 s6))))
(define-fun b15 () Int (ite (= k15 1) (o s1 b25) (ite (= k15 2) (o b12 b35) (ite (= k15 3) (o b13 b45) (o b14 s5)))))
(define-fun b26 () Int (ite (= k26 2) (o s2 b36) (ite (= k26 3) (o b23 b46) (ite (= k26 4) (o b24 b56) (o b25 s6)))))
(define-fun b16 () Int
  (ite (= k16 1) (o s1 b26)
  (ite (= k16 2) (o b12 b36)
  (ite (= k16 3) (o b13 b46)
  (ite (= k16 4) (o b14 b56) (o b15 s6))))))

; Consecutively applicable from c: membership of the atom stays 0 or 1 after every event.
(declare-const c Int)
(define-fun is_bit ((n Int)) Bool (or (= n 0) (= n 1)))
(define-fun run_from ((n Int)) Bool
  (and (is_bit n) (is_bit (+ n s1)) (is_bit (+ n s1 s2)) (is_bit (+ n s1 s2 s3)) (is_bit (+ n s1 s2 s3 s4))
       (is_bit (+ n s1 s2 s3 s4 s5)) (is_bit (+ n s1 s2 s3 s4 s5 s6))))
(define-fun sum () Int (+ s1 s2 s3 s4 s5 s6))

; The nonzero signs alternate: none repeats the last nonzero one before it.
(define-fun last2 () Int (ite (= s2 0) s1 s2))
(define-fun last3 () Int (ite (= s3 0) last2 s3))
(define-fun last4 () Int (ite (= s4 0) last3 s4))
(define-fun last5 () Int (ite (= s5 0) last4 s5))
(define-fun new ((last Int) (s Int)) Bool (or (= s 0) (not (= s last))))
(define-fun alternating () Bool (and (new s1 s2) (new last2 s3) (new last3 s4) (new last4 s5) (new last5 s6)))

(push)
(assert (run_from c))
(assert (not (or (= s1 0) (= s2 0) (= s3 0) (= s4 0) (= s5 0) (= s6 0))))
(echo "possible: a run of six events that all mention the atom")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (run_from c))
(assert (not (= b16 sum)))
(echo "proved: every bracketing of a run is the sum, without a clamp")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (run_from c))
(assert (not (and (= b16 (clamp sum)) (is_sign sum))))
(echo "proved: every bracketing of a run is the clamp of the sum, and the sum is a sign")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= alternating (or (run_from 0) (run_from 1)))))
(echo "proved: six signs are a run from somewhere iff the nonzero ones alternate")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= b16 (clamp sum))))
(echo "refuted: so it is without a run")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (run_from c))
(assert (not (= b16 b15)))
(echo "refuted: the last event of a run never counts")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (and (is_bit c) (is_bit (+ c s1)) (is_bit (+ c s1 s2)) (is_bit (+ c s1 s2 s3)) (is_bit (+ c s1 s2 s3 s4))))
(assert (is_bit (+ c s1 s2 s3 s4 s5)))
(assert (not (= b16 sum)))
(echo "refuted: the last event of a run need not be applicable")
(set-info :status sat)
(check-sat)
(pop)
