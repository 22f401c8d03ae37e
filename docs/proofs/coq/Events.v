(** Events (Def. 3), their composition (Def. 4), and what of the group laws holds.

    An event is a sign function of finite support; it carries a list that contains its support. Two events are equal, [==],
    if they agree at every atom: no axiom of extensionality is needed anywhere. *)

From Coq Require Import ZArith List Bool Lia Setoid Morphisms.
Import ListNotations.

(** * Signs *)

Inductive sign := Minus | Zero | Plus.

Definition to_Z (s : sign) : Z := match s with Minus => -1 | Zero => 0 | Plus => 1 end.
Definition clamp (n : Z) : sign := match n with Zneg _ => Minus | Z0 => Zero | Zpos _ => Plus end.
Definition clamped_sum (s t : sign) : sign := clamp (to_Z s + to_Z t).
Definition negate (s : sign) : sign := match s with Minus => Plus | Zero => Zero | Plus => Minus end.

Lemma clamp_is_clamp : forall n, to_Z (clamp n) = Z.max (-1) (Z.min 1 n).
Proof. intros [|p|p]; cbn [clamp to_Z]; lia. Qed.
Lemma clamp_to_Z : forall s, clamp (to_Z s) = s.
Proof. now intros []. Qed.
Lemma to_Z_injective : forall s t, to_Z s = to_Z t -> s = t.
Proof. now intros [] []. Qed.
Lemma to_Z_clamp : forall n, (-1 <= n <= 1)%Z -> to_Z (clamp n) = n.
Proof. intros n H. rewrite clamp_is_clamp. lia. Qed.

(** Brackets matter at (s, s, −s) and (−s, s, s), s ≠ 0. *)
Definition brackets_matter (s t u : sign) : Prop := s <> Zero /\ u = negate s /\ (t = s \/ t = u).

Lemma brackets_matter_correct : forall s t u,
  clamped_sum (clamped_sum s t) u = clamped_sum s (clamped_sum t u) <-> ~ brackets_matter s t u.
Proof.
  unfold brackets_matter; intros [] [] []; cbn; split; intros; try reflexivity; try discriminate;
    try (intros (? & ? & [? | ?]); congruence); exfalso; match goal with H : ~ _ |- _ => apply H end;
    repeat split; auto; discriminate.
Qed.

Definition signs := [Minus; Zero; Plus].
Definition sign_eq (s t : sign) : bool := Z.eqb (to_Z s) (to_Z t).
Definition disagree (t : sign * sign * sign) : bool :=
  let '(s, t, u) := t in negb (sign_eq (clamped_sum (clamped_sum s t) u) (clamped_sum s (clamped_sum t u))).
Definition triples := list_prod (list_prod signs signs) signs.

Theorem exactly_four_of_27 :
  length triples = 27 /\
  filter disagree triples = [(Minus, Minus, Plus); (Minus, Plus, Plus); (Plus, Minus, Minus); (Plus, Plus, Minus)].
Proof. now split. Qed.

(** * Events *)

Section Events.

Variable Atom : Type.

Record event := {
  value :> Atom -> sign;
  support : list Atom;
  supported : forall x, value x <> Zero -> In x support }.

Definition same (e f : event) : Prop := forall x, e x = f x.
Infix "==" := same (at level 70).

Global Instance same_equivalence : Equivalence same.
Proof. split; red; unfold same; congruence. Qed.

Program Definition empty : event := {| value := fun _ => Zero; support := [] |}.
Program Definition inverse (e : event) : event := {| value := fun x => negate (e x); support := support e |}.
Next Obligation. apply (supported e). now intros E; rewrite E in H. Qed.
Program Definition compose (e f : event) : event :=
  {| value := fun x => clamped_sum (e x) (f x); support := support e ++ support f |}.
Next Obligation.
  apply in_or_app. destruct (e x) eqn:E.
  - left. apply (supported e). now rewrite E.
  - right. apply (supported f). intros F. now rewrite F in H.
  - left. apply (supported e). now rewrite E.
Qed.

Global Instance compose_proper : Proper (same ==> same ==> same) compose.
Proof. intros e e' E f f' F x; cbn. now rewrite E, F. Qed.
Global Instance inverse_proper : Proper (same ==> same) inverse.
Proof. intros e e' E x; cbn. now rewrite E. Qed.

(** ** Def. 3 and Def. 4 to the letter *)

Definition additions (e : event) (x : Atom) : bool := sign_eq (e x) Plus.
Definition subtractions (e : event) (x : Atom) : bool := sign_eq (e x) Minus.
Definition finite (c : Atom -> bool) : Prop := exists l, forall x, c x = true -> In x l.

Theorem event_is_a_disjoint_pair : forall e,
  finite (additions e) /\ finite (subtractions e) /\ forall x, additions e x && subtractions e x = false.
Proof.
  intros e; unfold additions, subtractions; repeat split.
  - exists (support e). intros x H. apply (supported e). now intros E; rewrite E in H.
  - exists (support e). intros x H. apply (supported e). now intros E; rewrite E in H.
  - intros x. now destruct (e x).
Qed.

Theorem disjoint_pair_is_an_event : forall a b,
  finite a -> finite b -> (forall x, a x && b x = false) ->
  exists e, ((forall x, additions e x = a x) /\ (forall x, subtractions e x = b x)) /\
    forall f, (forall x, additions f x = a x) -> (forall x, subtractions f x = b x) -> f == e.
Proof.
  intros a b [la A] [lb B] D.
  assert (S : forall x, (if a x then Plus else if b x then Minus else Zero) <> Zero -> In x (la ++ lb)).
  { intros x H. apply in_or_app. destruct (a x) eqn:?; [left | destruct (b x) eqn:?; [right | congruence]]; auto. }
  exists {| value := fun x => if a x then Plus else if b x then Minus else Zero; support := la ++ lb; supported := S |}.
  unfold additions, subtractions, same; cbn. repeat split.
  - intros x. now destruct (a x), (b x).
  - intros x. specialize (D x). now destruct (a x), (b x).
  - intros f F G x. specialize (F x); specialize (G x). rewrite <- F, <- G. now destruct (f x).
Qed.

Theorem compose_is_definition_4 : forall e f x,
  additions (compose e f) x =
    (additions e x && negb (subtractions f x)) || (additions f x && negb (subtractions e x)) /\
  subtractions (compose e f) x =
    (subtractions e x && negb (additions f x)) || (subtractions f x && negb (additions e x)).
Proof. intros e f x; unfold additions, subtractions; cbn. now destruct (e x), (f x). Qed.

(** ** What holds. Closure is the type of [compose]. *)

Theorem compose_commutative : forall e f, compose e f == compose f e.
Proof. intros e f x; cbn. now destruct (e x), (f x). Qed.

Theorem compose_identity : forall e, compose e empty == e /\ compose empty e == e.
Proof. intros e; split; intros x; cbn; now destruct (e x). Qed.

Theorem identity_unique : forall f, (forall e, compose e f == e) -> f == empty.
Proof. intros f H x. specialize (H empty x). cbn in *. now destruct (f x). Qed.

Theorem compose_inverse : forall e, compose e (inverse e) == empty /\ compose (inverse e) e == empty.
Proof. intros e; split; intros x; cbn; now destruct (e x). Qed.

Theorem inverse_unique : forall e f, compose e f == empty -> f == inverse e.
Proof. intros e f H x. specialize (H x). cbn in *. now destruct (e x), (f x). Qed.

Theorem compose_idempotent : forall e, compose e e == e.
Proof. intros e x; cbn. now destruct (e x). Qed.

(** ** When brackets do not matter *)

Theorem associative_iff : forall e f g,
  compose (compose e f) g == compose e (compose f g) <-> forall x, ~ brackets_matter (e x) (f x) (g x).
Proof.
  intros e f g; split.
  - intros H x. apply brackets_matter_correct. apply (H x).
  - intros H x. apply (brackets_matter_correct (e x) (f x) (g x)), H.
Qed.

Theorem differs_exactly_at_bad_atoms : forall e f g x,
  compose (compose e f) g x <> compose e (compose f g) x <-> brackets_matter (e x) (f x) (g x).
Proof.
  intros e f g x; cbn. pose proof (brackets_matter_correct (e x) (f x) (g x)) as H. split.
  - intros N. unfold brackets_matter. destruct (e x), (f x), (g x); cbn in *; try congruence;
      repeat split; auto; discriminate.
  - intros B E. now apply H in E.
Qed.

(** ** What fails, whenever there is an atom at all *)

Variable eq_dec : forall x y : Atom, {x = y} + {x <> y}.

Program Definition addition (x : Atom) : event :=
  {| value := fun y => if eq_dec x y then Plus else Zero; support := [x] |}.
Next Obligation. destruct (eq_dec x x0); auto; congruence. Qed.

Lemma addition_at : forall x, addition x x = Plus.
Proof. intros x; cbn. now destruct (eq_dec x x). Qed.

Theorem compose_not_associative : forall x : Atom,
  ~ forall e f g, compose (compose e f) g == compose e (compose f g).
Proof.
  intros x H. specialize (H (addition x) (addition x) (inverse (addition x)) x).
  cbn in H. now destruct (eq_dec x x).
Qed.

Theorem shortest_refutation : forall e,
  compose (compose e e) (inverse e) == empty /\ compose e (compose e (inverse e)) == e.
Proof. intros e; split; intros x; cbn; now destruct (e x). Qed.

Theorem compose_not_cancellative : forall e, ~ e == empty ->
  exists f g, compose e f == compose e g /\ ~ f == g.
Proof. intros e N. exists e, empty. split; [intros x; cbn; now destruct (e x) | exact N]. Qed.

Theorem some_event_is_not_empty : forall x, ~ addition x == empty.
Proof. intros x H. specialize (H x). rewrite addition_at in H. discriminate. Qed.

End Events.

(** In a group only the identity is idempotent, so a group in which every element is has one element. *)
Theorem idempotent_in_a_group_is_the_identity : forall (G : Type) (op : G -> G -> G) (inv : G -> G) (one : G),
  (forall a b c, op (op a b) c = op a (op b c)) -> (forall a, op one a = a) -> (forall a, op (inv a) a = one) ->
  forall g, op g g = g -> g = one.
Proof.
  intros G op inv one A U I g H. rewrite <- (U g). rewrite <- (I g) at 1. rewrite A, H. apply I.
Qed.

Arguments value {Atom}.
Arguments support {Atom}.
Arguments supported {Atom}.
Arguments same {Atom}.
Arguments empty {Atom}.
Arguments inverse {Atom}.
Arguments compose {Atom}.
Arguments additions {Atom}.
Arguments subtractions {Atom}.
Arguments finite {Atom}.
Declare Scope event_scope.
Infix "==" := same (at level 70) : event_scope.
