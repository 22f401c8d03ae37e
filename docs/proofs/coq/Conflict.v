(** Conflicts (Def. 2), Proposition 1, and cycles (Def. 5). *)

From Coq Require Import ZArith List Bool Lia.
From Rota Require Import Events Delta Run.
Import ListNotations.
Local Open Scope event_scope.

(** * Def. 2 *)

Section Conflicts.

Variables Atom PlanType : Type.

Record allocation := { plan_type : PlanType; atoms :> Atom -> bool }.
Implicit Types c d : allocation.

Definition conflicts_with c d : Prop := plan_type c = plan_type d /\ exists x, c x = true /\ d x = false.
Definition in_conflict c d : Prop := conflicts_with c d \/ conflicts_with d c.

Theorem no_conflict_with_oneself : forall c, ~ in_conflict c c.
Proof. intros c [(_ & x & A & B) | (_ & x & A & B)]; congruence. Qed.

Theorem being_in_conflict_is_symmetric : forall c d, in_conflict c d <-> in_conflict d c.
Proof. unfold in_conflict; tauto. Qed.

Theorem conflict_is_directed : forall (x : Atom) (p : PlanType),
  exists c d, conflicts_with c d /\ ~ conflicts_with d c.
Proof.
  intros x p. exists {| plan_type := p; atoms := fun _ => true |}, {| plan_type := p; atoms := fun _ => false |}.
  split; [split; [reflexivity | now exists x] |]. intros (_ & y & A & _). discriminate.
Qed.

Theorem never_between_plan_types : forall c d, plan_type c <> plan_type d -> ~ in_conflict c d.
Proof. intros c d N [[E _] | [E _]]; congruence. Qed.

Lemma in_list_or_included : forall c d (l : list Atom),
  (exists x, c x = true /\ d x = false) \/ forall x, In x l -> c x = true -> d x = true.
Proof.
  intros c d l. induction l as [| y l [I | I]].
  - now right.
  - now left.
  - destruct (c y) eqn:C, (d y) eqn:D; try (right; intros x [<- | J]; [congruence | now apply I]).
    left. now exists y.
Qed.

(** For finite allocations the cause can be found, so no excluded middle is needed. *)
Theorem in_conflict_iff_different : forall c d, finite (atoms c) -> finite (atoms d) -> plan_type c = plan_type d ->
  (in_conflict c d <-> ~ atoms c ≡ atoms d).
Proof.
  intros c d [lc C] [ld D] P; split.
  - intros [(_ & x & A & B) | (_ & x & A & B)] E; rewrite (E x) in *; congruence.
  - intros N. destruct (in_list_or_included c d lc) as [H | H]; [now left |].
    destruct (in_list_or_included d c ld) as [K | K]; [right; now split |].
    exfalso. apply N. intros x. destruct (c x) eqn:A, (d x) eqn:B; auto.
    + rewrite <- B, H; auto.
    + now rewrite <- A, K by auto.
Qed.

End Conflicts.

(** * Proposition 1, within one plan type. An agent that does not execute it holds ∅. *)

Section Proposition1.

Variables Agent Atom : Type.
Variable agent : Atom -> Agent.

(** For any sets whatever, of any cardinality, as long as it is decided whether b's own allocation holds the cause. *)
Theorem proposition_1_for_any_sets : forall (belief : Agent -> Atom -> Prop) (a1 a2 : Agent) (x : Atom),
  belief a1 x -> ~ belief a2 x ->
  (belief (agent x) x -> belief (agent x) x /\ ~ belief a2 x) /\
  (~ belief (agent x) x -> belief a1 x /\ ~ belief (agent x) x).
Proof. tauto. Qed.

Variable belief : Agent -> set Atom.
Definition caused_by (a b : Agent) (x : Atom) : Prop := belief a x = true /\ belief b x = false.
Definition conflict (a b : Agent) : Prop := exists x, caused_by a b x \/ caused_by b a x.
Definition witness (a1 a2 : Agent) (x : Atom) : Agent := if belief (agent x) x then a2 else a1.

Theorem proposition_1_witness : forall a1 a2 x, caused_by a1 a2 x ->
  if belief (agent x) x then caused_by (agent x) a2 x else caused_by a1 (agent x) x.
Proof. intros a1 a2 x [A B]. destruct (belief (agent x) x) eqn:E; now split. Qed.

Theorem proposition_1 : forall a1 a2 x, caused_by a1 a2 x -> conflict a1 (agent x) \/ conflict a2 (agent x).
Proof.
  intros a1 a2 x H. pose proof (proposition_1_witness a1 a2 x H) as W.
  destruct (belief (agent x) x); [right | left]; exists x; tauto.
Qed.

Theorem witness_is_not_b : forall a1 a2 x, caused_by a1 a2 x ->
  witness a1 a2 x <> agent x /\ (agent x = a1 -> witness a1 a2 x = a2) /\ (agent x = a2 -> witness a1 a2 x = a1).
Proof.
  intros a1 a2 x [A B]. unfold witness. repeat split.
  - destruct (belief (agent x) x) eqn:E; intros F; rewrite <- F in E; congruence.
  - intros E. now rewrite E, A.
  - intros E. now rewrite E, B.
Qed.

(** b's next message, its own part of its own allocation, is a non-empty event at the witness. *)
Theorem b_s_message_is_news : forall a1 a2 x (e : event Atom), caused_by a1 a2 x ->
  (forall y, agent y = agent x -> to_Z (e y) = (chi (belief (agent x) y) - chi (belief (witness a1 a2 x) y))%Z) ->
  ~ e == empty.
Proof.
  intros a1 a2 x e [A B] H N. specialize (H x eq_refl). rewrite (N x) in H. unfold witness in H.
  destruct (belief (agent x) x) eqn:E; rewrite ?E, ?A, ?B in H; cbn in H; lia.
Qed.

End Proposition1.

(** Literally, with no allocation where an agent does not execute the plan type, it is false: one atom, about an agent
    that executes nothing; a₁ believes it, a₂ does not, and b is in conflict with nobody. *)
Inductive three := A1 | A2 | B.
Definition literal_belief (a : three) : option (set Datatypes.unit) :=
  match a with A1 => Some (fun _ => true) | A2 => Some (fun _ => false) | B => None end.
Definition literally_in_conflict (a b : three) : Prop :=
  exists c d, literal_belief a = Some c /\ literal_belief b = Some d /\
    exists x, (c x = true /\ d x = false) \/ (d x = true /\ c x = false).
Theorem proposition_1_fails_literally : (* with In(b, p, τ) := tt and b := B *)
  (exists c d, literal_belief A1 = Some c /\ literal_belief A2 = Some d /\ c tt = true /\ d tt = false) /\
  ~ (literally_in_conflict A1 B \/ literally_in_conflict A2 B).
Proof.
  split; [now exists (fun _ => true), (fun _ => false) |].
  intros [(? & ? & _ & E & _) | (? & ? & _ & E & _)]; discriminate.
Qed.

(** * Def. 5 *)

Section Cycles.

Variables Agent Atom : Type.
Variable agent : Atom -> Agent.
Variable b : Agent.
Implicit Types e : event Atom.
Implicit Types c : set Atom.

Definition silent_about_b e : Prop := forall x, agent x = b -> e x = Zero.
Definition restored c c2 : Prop := forall x, agent x = b -> c x = c2 x.

Theorem cycle_iff_restored : forall em er c c1 c2, leads em c c1 -> leads er c1 c2 ->
  (silent_about_b (compose em er) <-> restored c c2).
Proof.
  intros em er c c1 c2 M R.
  pose proof (proj1 (leads_iff _ _ _) (difference_is_a_functor _ em er c c1 c2 M R)) as L.
  split; intros H x X; specialize (L x); specialize (H x X).
  - rewrite H in L. unfold chi in L. destruct (c x), (c2 x); cbn in L; congruence || lia.
  - rewrite H in L. apply to_Z_injective. rewrite L. cbn. lia.
Qed.

Theorem cycle_iff_part_is_undone : forall em er,
  silent_about_b (compose em er) <-> forall x, agent x = b -> er x = inverse em x.
Proof.
  intros em er; split; intros H x X; specialize (H x X); cbn in *; destruct (em x), (er x); cbn in *; congruence.
Qed.

(** The trap: if e_r may be any event, b going and returning counts, though nobody reallocated. *)
Theorem b_alternating_counts_if_e_r_is_any_event : forall em em' c c1,
  leads em c c1 -> leads em' c1 c -> silent_about_b (compose em em').
Proof. intros em em' c c1 M R. now apply (cycle_iff_restored em em' c c1 c M R). Qed.

End Cycles.
