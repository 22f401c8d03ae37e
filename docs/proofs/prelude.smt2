; Definitions that every proof starts from: the runner puts this text before each of them. Nothing is asserted here, so
; nothing here can contradict anything. By hand: cat prelude.smt2 def-4-commutative.smt2 | z3 -in
;
; Sets of atoms are arrays into Bool, over atoms of which nothing at all is known. The set operations below act atom by
; atom, hence results are finite wherever the given sets are: what is proved for all sets holds for the finite ones, and
; every set that a proof constructs is a combination of given ones.

(declare-sort Atom 0)
(define-sort Atoms () (Array Atom Bool))
(define-fun none () Atoms ((as const Atoms) false))
(define-fun only ((x Atom)) Atoms (store none x true))
(define-fun has ((c Atoms) (x Atom)) Bool (select c x))
(define-fun unite ((c Atoms) (d Atoms)) Atoms ((_ map or) c d))
(define-fun intersect ((c Atoms) (d Atoms)) Atoms ((_ map and) c d))
(define-fun subtract ((c Atoms) (d Atoms)) Atoms ((_ map and) c ((_ map not) d)))
(define-fun is_subset ((c Atoms) (d Atoms)) Bool (= (subtract c d) none))

; Def. 3: a pair (additions, subtractions) is an event iff the two are disjoint.
(declare-datatypes ((Pair 0)) (((pair (plus Atoms) (minus Atoms)))))
(define-fun is_event ((e Pair)) Bool (= (intersect (plus e) (minus e)) none))
(define-fun nothing () Pair (pair none none))
(define-fun mentioned ((e Pair)) Atoms (unite (plus e) (minus e)))

; Def. 4, as printed.
(define-fun compose ((e Pair) (f Pair)) Pair
  (pair (unite (subtract (plus e) (minus f)) (subtract (plus f) (minus e)))
        (unite (subtract (minus e) (plus f)) (subtract (minus f) (plus e)))))
(define-fun inverse ((e Pair)) Pair (pair (minus e) (plus e)))

; The same atom by atom: the value e(x) of an event, and the clamped sum of two values.
(define-fun value ((e Pair) (x Atom)) Int (- (ite (has (plus e) x) 1 0) (ite (has (minus e) x) 1 0)))
(define-fun is_sign ((s Int)) Bool (and (<= (- 1) s) (<= s 1)))
(define-fun clamp ((n Int)) Int (ite (> n 1) 1 (ite (< n (- 1)) (- 1) n)))
(define-fun clamped_sum ((s Int) (t Int)) Int (clamp (+ s t)))

; The action on sets, and the event that leads from one set to another.
(define-fun chi ((c Atoms) (x Atom)) Int (ite (has c x) 1 0))
(define-fun applicable ((e Pair) (c Atoms)) Bool (and (= (intersect (plus e) c) none) (is_subset (minus e) c)))
(define-fun apply ((e Pair) (c Atoms)) Atoms (unite (subtract c (minus e)) (plus e)))
(define-fun difference ((before Atoms) (after Atoms)) Pair (pair (subtract after before) (subtract before after)))
