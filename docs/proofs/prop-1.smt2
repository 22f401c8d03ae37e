; If a₁ and a₂ are in conflict, caused by x = In(b, p, τ), one of them is in conflict with b, by the same cause: a₂ if x is
; in b's own allocation, a₁ if it is not. An agent that does not execute the plan type holds ∅ of it.
; Paper: Prop. 1.
; Theory: docs/algebra.md, Conflict, Proposition 1, cycle.
; Code: proposition_1. Tests: conflict.proposition_1.witness_is_in_conflict_with_b,
; conflict.proposition_1_theorems.b_is_news_to_the_witness.
; One plan type throughout. The literal reading, which fails, is prop-1-literal.

(declare-sort Agent 0)
(declare-fun agent (Atom) Agent)
(declare-fun belief (Agent) Atoms)
(define-fun caused_by ((a Agent) (b Agent) (x Atom)) Bool (and (has (belief a) x) (not (has (belief b) x))))
(define-fun in_conflict ((a Agent) (b Agent)) Bool (not (= (belief a) (belief b))))

(declare-const a1 Agent)
(declare-const a2 Agent)
(declare-const x Atom)
(define-fun b () Agent (agent x))
(define-fun witness () Agent (ite (has (belief b) x) a2 a1))
(assert (caused_by a1 a2 x))

(push)
(assert (distinct a1 a2 b))
(assert (has (belief b) x))
(echo "possible: a cause about a third agent that confirms it")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (distinct a1 a2 b))
(assert (= (belief b) none))
(echo "possible: a cause about a third agent that does not execute the plan type")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (= b a1))
(echo "possible: a cause about a₁")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (= b a2))
(echo "possible: a cause about a₂")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (or (in_conflict a1 b) (in_conflict a2 b))))
(echo "proved: one of the two is in conflict with b")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (ite (has (belief b) x) (caused_by b a2 x) (caused_by a1 b x))))
(echo "proved: the witness is in conflict with b, caused by x")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (or (= witness b) (and (= b a1) (not (= witness a2))) (and (= b a2) (not (= witness a1)))))
(echo "proved: the witness is not b; if b is one of the two, the witness is the other")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(declare-const of_b Atoms)
(assert (forall ((y Atom)) (= (has of_b y) (= (agent y) b))))
(assert (= (difference (intersect (belief witness) of_b) (intersect (belief b) of_b)) nothing))
(echo "proved: what b says about itself is news to the witness")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (not (and (in_conflict a1 b) (in_conflict a2 b))))
(echo "refuted: both are in conflict with b")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (in_conflict a1 b)))
(echo "refuted: the agent that holds the cause is in conflict with b")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (not (in_conflict a2 b)))
(echo "refuted: the agent that does not hold the cause is in conflict with b")
(set-info :status sat)
(check-sat)
(pop)
