; The trap in "let e_r be the next allocation event": if e_r may be any event, b alternating between two tasks counts as a
; cycle at an agent that never reallocates. So e_r is the next reallocation.
; Paper: Def. 5 (needs a reading).
; Theory: docs/algebra.md, Conflict, Proposition 1, cycle.
; Code: is_cycle, cycle_monitor. Tests: every_monitor.b_alternating_alone_is_no_cycle.

(declare-sort Agent 0)
(declare-fun agent (Atom) Agent)
(declare-const b Agent)
(define-fun silent_about_b ((e Pair)) Bool (forall ((x Atom)) (=> (= (agent x) b) (not (has (mentioned e) x)))))

; A message from b changes nothing but b's part, a reallocation changes what it likes.
(declare-datatypes ((Step 0)) (((message (said Pair)) (reallocation (done Pair)))))
(define-fun event_of ((s Step)) Pair (ite ((_ is message) s) (said s) (done s)))
(define-fun is_step ((s Step)) Bool
  (and (is_event (event_of s))
       (=> ((_ is message) s) (forall ((x Atom)) (=> (has (mentioned (said s)) x) (= (agent x) b))))))
(define-fun any_cycle ((s Step) (t Step)) Bool
  (and ((_ is message) s) (not (= (said s) nothing)) (silent_about_b (compose (said s) (event_of t)))))
(define-fun cycle ((s Step) (t Step)) Bool (and (any_cycle s t) ((_ is reallocation) t)))

(declare-const s Step)
(declare-const t Step)
(declare-const c Atoms)
(assert (is_step s))
(assert (is_step t))
(assert (applicable (event_of s) c))
(assert (applicable (event_of t) (apply (event_of s) c)))

(push)
(assert (cycle s t))
(assert (not (= (done t) (inverse (said s)))))
(echo "possible: a cycle whose reallocation does more than undo the message")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert (any_cycle s t))
(assert (not ((_ is reallocation) t)))
(echo "refuted: with e_r any event, a cycle shows that the agent reallocated")
(set-info :status sat)
(check-sat)
(pop)

(push)
(assert ((_ is message) s))
(assert ((_ is message) t))
(assert (not (= (said s) nothing)))
(assert (= (apply (said t) (apply (said s) c)) c))
(assert (not (any_cycle s t)))
(echo "proved: with e_r any event, whenever b goes and returns it counts as a cycle")
(set-info :status unsat)
(check-sat)
(pop)

(push)
(assert (cycle s t))
(assert (or (not ((_ is reallocation) t)) (= (done t) nothing)))
(echo "proved: with e_r the next reallocation, a cycle shows that the agent reallocated, and changed something")
(set-info :status unsat)
(check-sat)
(pop)
