(** The action of events on sets, and the theorem of runs: of consecutively applicable events every bracketing, of any
    size and shape, is the same event, namely the sum, which needs no clamp. *)

From Coq Require Import ZArith List Bool Lia Setoid Morphisms.
From Rota Require Import Events Delta.
Import ListNotations.
Local Open Scope event_scope.

Section Runs.

Variable Atom : Type.
Implicit Types e f g : event Atom.

(** Sets of atoms, with decidable membership, not necessarily finite. *)
Definition set := Atom -> bool.
Implicit Types c d : set.
Definition equal c d : Prop := forall x, c x = d x.
Infix "≡" := equal (at level 70).
Definition chi (b : bool) : Z := if b then 1 else 0.

Global Instance equal_equivalence : Equivalence equal.
Proof. split; red; unfold equal; congruence. Qed.

(** * The action *)

(** e⁺ ∩ C = ∅ and e⁻ ⊆ C. *)
Definition applicable e c : Prop :=
  forall x, (additions e x = true -> c x = false) /\ (subtractions e x = true -> c x = true).
(** (C ∖ e⁻) ∪ e⁺. *)
Definition apply e c : set := fun x => (c x && negb (subtractions e x)) || additions e x.

Ltac by_cases := unfold apply, additions, subtractions, chi in *; cbn in *;
  repeat match goal with
  | e : event Atom, x : Atom |- _ => destruct (value e x); clear e
  | c : Atom -> bool, x : Atom |- _ => destruct (c x); clear c
  | c : set, x : Atom |- _ => destruct (c x); clear c
  end; cbn in *; intuition (try congruence; try discriminate; try lia).

Theorem applicable_iff : forall e c, applicable e c <-> forall x, (0 <= chi (c x) + to_Z (e x) <= 1)%Z.
Proof.
  intros e c; split; intros H x; specialize (H x); by_cases.
Qed.

Theorem chi_apply : forall e c, applicable e c -> forall x, chi (apply e c x) = (chi (c x) + to_Z (e x))%Z.
Proof. intros e c H x; specialize (H x); by_cases. Qed.

Theorem apply_empty : forall c, applicable empty c /\ apply empty c ≡ c.
Proof. intros c; split; intros x; by_cases. Qed.

Theorem apply_compose : forall e f c, applicable e c -> applicable f (apply e c) ->
  applicable (compose e f) c /\ apply (compose e f) c ≡ apply f (apply e c).
Proof. intros e f c E F; split; intros x; specialize (E x); specialize (F x); by_cases. Qed.

(** e leads from C to C′: it is applicable, and the result is C′. *)
Definition leads e c d : Prop := applicable e c /\ apply e c ≡ d.

Lemma leads_iff : forall e c d, leads e c d <-> forall x, to_Z (e x) = (chi (d x) - chi (c x))%Z.
Proof.
  intros e c d; split.
  - intros [A E] x. specialize (A x); specialize (E x). by_cases.
  - intros H; split; intros x; specialize (H x); by_cases.
Qed.

Theorem leading_event_is_unique : forall e f c d, leads e c d -> leads f c d -> e == f.
Proof.
  intros e f c d E F x. rewrite leads_iff in *. apply to_Z_injective. now rewrite E, F.
Qed.

(** (C′ ∖ C, C ∖ C′). *)
Theorem difference_exists : forall c d, finite c -> finite d ->
  exists e, (forall x, additions e x = d x && negb (c x)) /\ (forall x, subtractions e x = c x && negb (d x)) /\
    leads e c d.
Proof.
  intros c d [lc C] [ld D].
  assert (S : forall x, clamp (chi (d x) - chi (c x)) <> Zero -> In x (lc ++ ld)).
  { intros x H. apply in_or_app. destruct (c x) eqn:?; [left; auto |]. destruct (d x) eqn:?; [right; auto |].
    now contradiction H. }
  exists {| value := fun x => clamp (chi (d x) - chi (c x)); support := lc ++ ld; supported := S |}.
  rewrite leads_iff. unfold additions, subtractions; cbn.
  repeat split; intros x; now destruct (c x), (d x).
Qed.

Theorem difference_is_a_functor : forall e f c0 c1 c2, leads e c0 c1 -> leads f c1 c2 -> leads (compose e f) c0 c2.
Proof.
  intros e f c0 c1 c2 E F. rewrite leads_iff in *. intros x. cbn. unfold clamped_sum.
  rewrite E, F, to_Z_clamp; unfold chi; destruct (c0 x), (c1 x), (c2 x); lia.
Qed.

Theorem inverse_leads_back : forall e c d, leads e c d -> leads (inverse e) d c.
Proof.
  intros e c d E. rewrite leads_iff in *. intros x. specialize (E x). cbn. destruct (e x); cbn in *; lia.
Qed.

(** * Runs *)

Fixpoint run (es : list (event Atom)) c d : Prop :=
  match es with
  | [] => c ≡ d
  | e :: es => applicable e c /\ run es (apply e c) d
  end.

Global Instance applicable_proper : Proper (eq ==> equal ==> iff) applicable.
Proof. intros e ? <- c d E. unfold applicable. now setoid_rewrite (fun x => E x). Qed.
Global Instance apply_proper : Proper (eq ==> equal ==> equal) apply.
Proof. intros e ? <- c d E x. unfold apply. now rewrite (E x). Qed.
Global Instance run_proper : Proper (eq ==> equal ==> equal ==> iff) run.
Proof.
  intros es ? <-. induction es as [| e es IH]; intros c c' C d d' D; cbn.
  - split; intros H x; [rewrite <- (C x), <- (D x) | rewrite (C x), (D x)]; apply H.
  - pose proof (applicable_proper e e eq_refl c c' C). pose proof (IH _ _ (apply_proper e e eq_refl c c' C) d d' D).
    tauto.
Qed.

Lemma run_append : forall es fs c d, run (es ++ fs) c d <-> exists m, run es c m /\ run fs m d.
Proof.
  induction es as [| e es IH]; intros fs c d; cbn.
  - split; [intros H; now exists c | intros (m & E & H); now apply (run_proper fs fs eq_refl c m E d d (reflexivity d))].
  - rewrite IH. split; [intros (A & m & E & F); now exists m | intros (m & (A & E) & F); split; [easy | now exists m]].
Qed.

(** Brackets of any shape. *)
Inductive bracketing := One (e : event Atom) | Two (l r : bracketing).
Fixpoint events (t : bracketing) : list (event Atom) :=
  match t with One e => [e] | Two l r => events l ++ events r end.
Fixpoint composed (t : bracketing) : event Atom :=
  match t with One e => e | Two l r => compose (composed l) (composed r) end.

Lemma bracketing_leads : forall t c d, run (events t) c d -> leads (composed t) c d.
Proof.
  induction t as [e | l L r R]; intros c d; cbn.
  - easy.
  - rewrite run_append. intros (m & E & F). exact (difference_is_a_functor _ _ c m d (L _ _ E) (R _ _ F)).
Qed.

Theorem brackets_of_a_run_do_not_matter : forall t u c d,
  events t = events u -> run (events t) c d -> composed t == composed u.
Proof.
  intros t u c d E H. apply (leading_event_is_unique _ _ c d); apply bracketing_leads; [| rewrite <- E]; exact H.
Qed.

Definition total (es : list (event Atom)) : delta Atom := fold_right (fun e sum => add (embed e) sum) zero es.

Lemma total_of_a_run : forall es c d, run es c d -> forall x, total es x = (chi (d x) - chi (c x))%Z.
Proof.
  induction es as [| e es IH]; intros c d; cbn.
  - intros H x. rewrite (H x). lia.
  - intros [A H] x. change (to_Z (e x) + total es x = chi (d x) - chi (c x))%Z.
    rewrite (IH _ _ H x), (chi_apply e c A x). lia.
Qed.

Theorem total_of_a_run_needs_no_clamp : forall es c d, run es c d -> forall x, (-1 <= total es x <= 1)%Z.
Proof.
  intros es c d H x. rewrite (total_of_a_run es c d H x). unfold chi. destruct (c x), (d x); lia.
Qed.

Theorem brackets_of_a_run_are_the_clamped_sum : forall t c d, run (events t) c d ->
  composed t == clamped (total (events t)) /\ delta_same (embed (composed t)) (total (events t)).
Proof.
  intros t c d H. pose proof (bracketing_leads t c d H) as L. rewrite leads_iff in L.
  assert (E : delta_same (embed (composed t)) (total (events t))).
  { intros x. rewrite (total_of_a_run _ c d H x). apply L. }
  split; [| exact E]. intros x. cbn. rewrite <- (E x). cbn. now rewrite clamp_to_Z.
Qed.

(** ** Consecutively applicable from somewhere iff, at each atom, the nonzero signs alternate *)

Fixpoint alternates (last : sign) (l : list sign) : Prop :=
  match l with
  | [] => True
  | Zero :: l => alternates last l
  | s :: l => s <> last /\ alternates s l
  end.
Definition alternating : list sign -> Prop := alternates Zero.

Definition at_atom (es : list (event Atom)) (x : Atom) : list sign := map (fun e => e x) es.
(** Whether an atom is a member before its first nonzero sign. *)
Fixpoint start (l : list sign) : bool :=
  match l with [] => false | Minus :: _ => true | Zero :: l => start l | Plus :: _ => false end.
Definition end_of (b : bool) : sign := if b then Plus else Minus.

Lemma run_iff_alternates : forall es c,
  (exists d, run es c d) <-> forall x, alternates (end_of (c x)) (at_atom es x).
Proof.
  induction es as [| e es IH]; intros c; cbn.
  - split; [easy | intros _; now exists c].
  - specialize (IH (apply e c)). split.
    + intros (d & A & H) x. assert (K := proj1 IH (ex_intro _ d H) x). specialize (A x).
      unfold apply, additions, subtractions, end_of in *. destruct (e x), (c x); cbn in *; intuition discriminate.
    + intros H. assert (A : applicable e c).
      { intros x. specialize (H x). unfold additions, subtractions, end_of in *.
        destruct (e x), (c x); cbn in *; intuition congruence. }
      destruct (proj2 IH) as (d & R).
      { intros x. specialize (H x). unfold apply, additions, subtractions, end_of in *.
        destruct (e x), (c x); cbn in *; intuition congruence. }
      now exists d.
Qed.

Lemma alternates_after_anything : forall l s, alternates s l -> alternating l.
Proof.
  unfold alternating. induction l as [| t l IH]; intros s; cbn; [easy |].
  destruct t; [intros [_ H]; split; [discriminate | exact H] | apply IH | intros [_ H]; split; [discriminate | exact H]].
Qed.
Lemma alternating_from_start : forall l, alternating l -> alternates (end_of (start l)) l.
Proof.
  unfold alternating. induction l as [| [] l IH]; cbn; [easy | | exact IH |]; intros [_ H]; split; easy.
Qed.

Theorem run_iff_signs_alternate : forall es,
  (exists c d, finite c /\ run es c d) <-> forall x, alternating (at_atom es x).
Proof.
  intros es; split.
  - intros (c & d & _ & H) x. eapply alternates_after_anything, (proj1 (run_iff_alternates es c)). now exists d.
  - intros H. set (c := fun x => start (at_atom es x)).
    destruct (proj2 (run_iff_alternates es c)) as (d & R).
    { intros x. apply alternating_from_start, H. }
    exists c, d. split; [| exact R]. exists (flat_map support es). intros x S. apply in_flat_map.
    unfold c in S. clear c d R H. induction es as [| e es IH]; cbn in S; [discriminate |].
    destruct (e x) eqn:E.
    + exists e. split; [now left |]. apply supported. now rewrite E.
    + destruct (IH S) as (f & I & J). exists f. split; [now right | exact J].
    + discriminate.
Qed.

(** ** Controls: what the theorem does not say *)

Variable eq_dec : forall x y : Atom, {x = y} + {x <> y}.

(** A run of any length, so the theorem speaks of something. *)
Fixpoint back_and_forth (n : nat) e : list (event Atom) :=
  match n with 0 => [] | S n => e :: back_and_forth n (inverse e) end.
Example runs_exist : forall n e c d, leads e c d -> exists m, run (back_and_forth n e) c m.
Proof.
  induction n as [| n IH]; intros e c d L; cbn.
  - now exists c.
  - destruct (IH (inverse e) d c (inverse_leads_back e c d L)) as (m & R). exists m.
    destruct L as [A E]. split; [exact A |].
    now apply (run_proper _ _ eq_refl _ _ E m m (reflexivity m)).
Qed.

(** Adding twice is no run, though there are no brackets to choose. *)
Example adding_twice_is_no_run : forall x c d, ~ run [addition Atom eq_dec x; addition Atom eq_dec x] c d.
Proof.
  intros x c d (_ & A & _). specialize (A x). unfold apply, additions in A. rewrite addition_at in A.
  cbn in A. rewrite orb_true_r in A. destruct A as [A _]. now specialize (A eq_refl).
Qed.

(** A run must not be permuted. *)
Example a_permuted_run_depends_on_brackets : forall x,
  let e := addition Atom eq_dec x in
  run [e; inverse e; e] (fun _ => false) (apply e (fun _ => false)) /\
  ~ compose (compose e e) (inverse e) == compose e (compose e (inverse e)).
Proof.
  intros x e; split.
  - split; [| split; [| split]]; intros y; unfold apply, additions, subtractions, e; cbn;
      destruct (eq_dec x y); cbn; intuition congruence.
  - intros H. specialize (H x). unfold e in H; cbn in H. now destruct (eq_dec x x).
Qed.

End Runs.

Arguments set : clear implicits.
Arguments equal {Atom}.
Arguments applicable {Atom}.
Arguments apply {Atom}.
Arguments leads {Atom}.
Arguments leads_iff {Atom}.
Infix "≡" := equal (at level 70) : event_scope.
