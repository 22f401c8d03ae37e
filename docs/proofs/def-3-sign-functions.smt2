; Events are the sign functions: disjoint pairs of sets and functions Atoms → {−1, 0, +1} correspond one to one.
; Paper: Def. 3.
; Theory: docs/algebra.md, introduction.
; Code: event::make. Tests: event.disjoint_pairs_of_sets_are_sign_functions_one_to_one.
; This is why an equation between events may be proved at a single atom: it holds iff it holds at every atom.

(declare-const e Pair)
(declare-const f Pair)
(assert (is_event e))
(assert (is_event f))

(push)
(assert (not (= (plus e) none)))
(assert (not (= (minus e) none)))
(assert (not (= e f)))
(echo "possible: two different events, one of which adds and subtracts")
(set-info :status sat)
(check-sat)
(pop)

(push)
(declare-const x Atom)
(assert (not (and (is_sign (value e x)) (= (has (plus e) x) (= (value e x) 1)) (= (has (minus e) x) (= (value e x) (- 1))))))
(echo "proved: an event is determined by its values, which are signs")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (= (= e f) (forall ((x Atom)) (= (value e x) (value f x))))))
(echo "proved: two events are equal iff they have the same value at every atom")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-fun s (Atom) Int)
(declare-const a Atoms)
(declare-const b Atoms)
(assert (forall ((x Atom)) (and (= (has a x) (= (s x) 1)) (= (has b x) (= (s x) (- 1))))))
(assert (not (and (is_event (pair a b)) (forall ((x Atom)) (=> (is_sign (s x)) (= (value (pair a b) x) (s x)))))))
(echo "proved: every sign function is the values of the event ({x : s(x) = +1}, {x : s(x) = −1})")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-const p Pair)
(declare-const q Pair)
(declare-const y Atom)
(assert (= p (pair (only y) (only y))))
(assert (= q nothing))
(assert (not (= p q)))
(assert (forall ((x Atom)) (= (value p x) (value q x))))
(echo "refuted: values determine the pair also where additions and subtractions overlap")
(set-info :status sat)
(check-sat)
(pop)
