(** Deltas: integer multiplicities of finite support. They form the free abelian group on the atoms, into which the events
    embed, and which clamps onto them. *)

From Coq Require Import ZArith List Bool Lia Setoid Morphisms Permutation.
From Rota Require Import Events.
Import ListNotations.

(** * Abelian groups, with an equality of their own *)

Record abelian_group := {
  carrier :> Type;
  eqv : carrier -> carrier -> Prop;
  op : carrier -> carrier -> carrier;
  unit : carrier;
  inv : carrier -> carrier;
  eqv_equivalence : Equivalence eqv;
  op_proper : Proper (eqv ==> eqv ==> eqv) op;
  inv_proper : Proper (eqv ==> eqv) inv;
  associative : forall a b c, eqv (op (op a b) c) (op a (op b c));
  commutative : forall a b, eqv (op a b) (op b a);
  identity : forall a, eqv (op unit a) a;
  inverses : forall a, eqv (op (inv a) a) unit }.
Arguments eqv {_}.
Arguments op {_}.
Arguments unit {_}.
Arguments inv {_}.
Infix "=G" := eqv (at level 70).
Global Existing Instance eqv_equivalence.
Global Existing Instance op_proper.
Global Existing Instance inv_proper.

Definition homomorphism (G H : abelian_group) (h : G -> H) : Prop :=
  Proper (eqv ==> eqv) h /\ forall a b, h (op a b) =G op (h a) (h b).

Section Groups.
Variable G : abelian_group.
Implicit Types a b c : G.

Lemma identity_right : forall a, op a unit =G a.
Proof. intros. now rewrite commutative, identity. Qed.
Lemma cancel : forall a b c, op a b =G op a c -> b =G c.
Proof.
  intros a b c H. rewrite <- (identity G b), <- (identity G c), <- (inverses G a), !associative. now rewrite H.
Qed.
Lemma inverse_right : forall a, op a (inv a) =G unit.
Proof. intros. now rewrite commutative, inverses. Qed.
Lemma inverse_of_unit : inv (unit : G) =G unit.
Proof. now rewrite <- (identity_right (inv unit)), inverses. Qed.
Lemma swap : forall a b c, op a (op b c) =G op b (op a c).
Proof. intros. now rewrite <- !associative, (commutative G a b). Qed.

(** Integer multiples. *)
Definition multiple (n : nat) (a : G) : G := Nat.iter n (op a) unit.
Definition times (n : Z) (a : G) : G :=
  if (0 <=? n)%Z then multiple (Z.to_nat n) a else inv (multiple (Z.to_nat (- n)) a).

Lemma multiple_S : forall n a, multiple (S n) a = op a (multiple n a).
Proof. reflexivity. Qed.

Lemma times_succ : forall n a, times (Z.succ n) a =G op a (times n a).
Proof.
  intros n a. unfold times. destruct (0 <=? n)%Z eqn:E.
  - apply Z.leb_le in E. replace (0 <=? Z.succ n)%Z with true by (symmetry; apply Z.leb_le; lia).
    rewrite Z2Nat.inj_succ by lia. now rewrite multiple_S.
  - apply Z.leb_gt in E. destruct (0 <=? Z.succ n)%Z eqn:F.
    + apply Z.leb_le in F. replace n with (-1)%Z by lia.
      change (unit =G op a (inv (op a unit))). now rewrite identity_right, inverse_right.
    + apply Z.leb_gt in F. replace (Z.to_nat (- n)) with (S (Z.to_nat (- Z.succ n))) by lia.
      rewrite multiple_S. set (m := multiple _ a). apply (cancel m).
      rewrite inverse_right, <- associative, (commutative G m a). now rewrite inverse_right.
Qed.

Global Instance times_proper : forall n, Proper (eqv ==> eqv) (times n).
Proof.
  assert (M : forall n, Proper (eqv ==> eqv) (multiple n)).
  { induction n; intros a b E; [reflexivity |]. rewrite !multiple_S. now rewrite (IHn a b E), E. }
  intros n a b E. unfold times. destruct (0 <=? n)%Z; now rewrite (M _ a b E).
Qed.

Lemma times_zero : forall a, times 0 a = unit.
Proof. reflexivity. Qed.
Lemma times_one : forall a, times 1 a =G a.
Proof. intros. change (op a unit =G a). apply identity_right. Qed.

Lemma times_add : forall m n a, times (m + n) a =G op (times m a) (times n a).
Proof.
  intros m n a. induction m using Z.peano_ind.
  - now rewrite times_zero, identity, Z.add_0_l.
  - now rewrite Z.add_succ_l, !times_succ, IHm, associative.
  - apply (cancel a). rewrite <- times_succ, <- associative, <- times_succ, <- Z.add_succ_l, Z.succ_pred. exact IHm.
Qed.

(** Sums over lists. *)
Definition sum {X : Type} (l : list X) (f : X -> G) : G := fold_right (fun x r => op (f x) r) unit l.

Lemma sum_permutation : forall (X : Type) (f : X -> G) l l', Permutation l l' -> sum l f =G sum l' f.
Proof.
  induction 1; cbn.
  - reflexivity.
  - now rewrite IHPermutation.
  - apply swap.
  - now transitivity (sum l' f).
Qed.
Lemma sum_equal : forall (X : Type) (f g : X -> G) l, (forall x, In x l -> f x =G g x) -> sum l f =G sum l g.
Proof. induction l; cbn; intros H; [reflexivity | rewrite H by auto; rewrite IHl by auto; reflexivity]. Qed.
Lemma sum_op : forall (X : Type) (f g : X -> G) l, sum l (fun x => op (f x) (g x)) =G op (sum l f) (sum l g).
Proof.
  induction l; cbn.
  - now rewrite identity.
  - rewrite IHl, !associative. now rewrite (swap (g a)).
Qed.
Lemma sum_filter : forall (X : Type) (f : X -> G) (p : X -> bool) l,
  (forall x, p x = false -> f x =G unit) -> sum (filter p l) f =G sum l f.
Proof.
  induction l; cbn; intros H; [reflexivity |]. destruct (p a) eqn:P; cbn.
  - now rewrite IHl.
  - now rewrite IHl, (H a P), identity.
Qed.
End Groups.
Arguments times {_}.
Arguments sum {_ _}.

Section Homomorphisms.
Variables (G H : abelian_group) (h : G -> H).
Hypothesis hom : homomorphism G H h.

Local Instance hom_proper : Proper (eqv ==> eqv) h := proj1 hom.

Lemma hom_unit : h unit =G unit.
Proof. apply (cancel H (h unit)). now rewrite <- (proj2 hom), (identity G), (identity_right H). Qed.
Lemma hom_times : forall n a, h (times n a) =G times n (h a).
Proof.
  intros n a. induction n using Z.peano_ind.
  - apply hom_unit.
  - now rewrite !times_succ, (proj2 hom), IHn.
  - apply (cancel H (h a)). rewrite <- (proj2 hom), <- !times_succ, !Z.succ_pred. exact IHn.
Qed.
Lemma hom_sum : forall (X : Type) (l : list X) f, h (sum l f) =G sum l (fun x => h (f x)).
Proof.
  unfold sum. induction l as [| x l IH]; intros f; cbn.
  - apply hom_unit.
  - now rewrite (proj2 hom), (IH f).
Qed.
End Homomorphisms.

(** * Deltas *)

Section Deltas.

Variable Atom : Type.
Variable eq_dec : forall x y : Atom, {x = y} + {x <> y}.
Local Open Scope Z_scope.

Record delta := {
  count :> Atom -> Z;
  delta_support : list Atom;
  delta_supported : forall x, count x <> 0 -> In x delta_support }.

Definition delta_same (d e : delta) : Prop := forall x, d x = e x.
Global Instance delta_same_equivalence : Equivalence delta_same.
Proof. split; red; unfold delta_same; congruence. Qed.

Program Definition zero : delta := {| count := fun _ => 0; delta_support := [] |}.
Program Definition add (d e : delta) : delta :=
  {| count := fun x => d x + e x; delta_support := delta_support d ++ delta_support e |}.
Next Obligation.
  apply in_or_app. destruct (Z.eq_dec (d x) 0) as [E | E].
  - right. apply delta_supported. lia.
  - left. now apply delta_supported.
Qed.
Program Definition scale (n : Z) (d : delta) : delta :=
  {| count := fun x => n * d x; delta_support := delta_support d |}.
Next Obligation. apply delta_supported. intros E. rewrite E in H. lia. Qed.

Program Definition deltas : abelian_group :=
  {| carrier := delta; eqv := delta_same; op := add; unit := zero; inv := scale (-1) |}.
Next Obligation. intros d d' D e e' E x; cbn. now rewrite (D x), (E x). Qed.
Next Obligation. intros d d' D x; cbn. now rewrite (D x). Qed.
Next Obligation. intros x; cbn -[Z.mul]; lia. Qed.
Next Obligation. intros x; cbn -[Z.mul]; lia. Qed.
Next Obligation. intros x; cbn -[Z.mul]; lia. Qed.
Next Obligation. intros x; cbn -[Z.mul]; lia. Qed.

(** A ℤ-module. *)
Theorem integers_act_as_a_module : forall (m n : Z) (d e : delta),
  delta_same (scale 1 d) d /\ delta_same (scale (m * n) d) (scale m (scale n d)) /\
  delta_same (scale (m + n) d) (add (scale m d) (scale n d)) /\
  delta_same (scale n (add d e)) (add (scale n d) (scale n e)).
Proof. intros; repeat split; intros x; cbn -[Z.mul]; lia. Qed.

Theorem deltas_cancel : forall d e f : delta, delta_same (add d e) (add d f) -> delta_same e f.
Proof. exact (cancel deltas). Qed.

Program Definition generator (x : Atom) : delta :=
  {| count := fun y => if eq_dec x y then 1 else 0; delta_support := [x] |}.
Next Obligation. destruct (eq_dec x x0); auto; lia. Qed.

Theorem generators_differ : forall x y, delta_same (generator x) (generator y) -> x = y.
Proof.
  intros x y H. specialize (H x). cbn in H. destruct (eq_dec x x); [| congruence]. now destruct (eq_dec y x).
Qed.

(** ** The universal property *)

Section Extension.
Variables (G : abelian_group) (f : Atom -> G).

Definition extend (d : delta) : G := sum (nodup eq_dec (delta_support d)) (fun x => times (d x) (f x)).

(** Whatever list of different atoms contains the support gives the same sum. *)
Lemma extend_any_list : forall (d : delta) l, NoDup l -> (forall x, d x <> 0 -> In x l) ->
  extend d =G sum l (fun x => times (d x) (f x)).
Proof.
  intros d l N S. unfold extend.
  set (p := fun x => negb (d x =? 0)). set (g := fun x => times (d x) (f x)).
  assert (P : forall x, p x = false -> g x =G unit).
  { intros x E. unfold p in E. apply negb_false_iff, Z.eqb_eq in E. unfold g. now rewrite E. }
  rewrite <- (sum_filter G _ g p (nodup _ _) P), <- (sum_filter G _ g p l P).
  apply sum_permutation, NoDup_Permutation.
  - apply NoDup_filter, NoDup_nodup.
  - apply NoDup_filter, N.
  - intros x. rewrite !filter_In, nodup_In. unfold p.
    split; intros [_ E]; (split; [| exact E]); apply negb_true_iff, Z.eqb_neq in E;
      [apply S | apply delta_supported]; exact E.
Qed.

Lemma extend_is_a_homomorphism : homomorphism deltas G extend.
Proof.
  split.
  - intros d e E. rewrite (extend_any_list e (nodup eq_dec (delta_support d))).
    + apply sum_equal. intros x _. cbn in E. now rewrite (E x).
    + apply NoDup_nodup.
    + intros x H. rewrite nodup_In. apply delta_supported. cbn in E. now rewrite (E x).
  - intros d e. set (l := nodup eq_dec (delta_support d ++ delta_support e)).
    assert (N : NoDup l) by apply NoDup_nodup.
    assert (D : forall x, d x <> 0 -> In x l)
      by (intros x H; unfold l; rewrite nodup_In; apply in_or_app; left; now apply delta_supported).
    assert (E : forall x, e x <> 0 -> In x l)
      by (intros x H; unfold l; rewrite nodup_In; apply in_or_app; right; now apply delta_supported).
    rewrite (extend_any_list d l N D), (extend_any_list e l N E), <- sum_op.
    change (extend (add d e) =G sum l (fun x => op (times (d x) (f x)) (times (e x) (f x)))).
    rewrite (extend_any_list (add d e) l N).
    + apply sum_equal. intros x _. apply times_add.
    + intros x H. cbn in H. destruct (Z.eq_dec (d x) 0); [apply E; lia | now apply D].
Qed.

Lemma extend_generator : forall x, extend (generator x) =G f x.
Proof.
  intros x. rewrite (extend_any_list (generator x) [x]).
  - cbn -[times]. destruct (eq_dec x x); [| congruence]. now rewrite identity_right, times_one.
  - constructor; [intros [] | constructor].
  - exact (delta_supported (generator x)).
Qed.
End Extension.

Lemma count_times : forall n (d : delta) x, count (times (n : Z) (d : deltas)) x = n * d x.
Proof.
  intros n d x. induction n using Z.peano_ind.
  - reflexivity.
  - rewrite (times_succ deltas n d x). cbn -[times]. rewrite IHn. lia.
  - pose proof (times_succ deltas (Z.pred n) d x) as E. rewrite Z.succ_pred in E. cbn -[times] in E.
    rewrite IHn in E. lia.
Qed.

Lemma delta_is_the_sum_of_its_generators : forall d, extend deltas generator d =G (d : deltas).
Proof.
  intros d x. unfold extend.
  assert (K : forall l, NoDup l ->
    count (sum l (fun y => times (d y) (generator y : deltas))) x = if in_dec eq_dec x l then d x else 0).
  { induction l as [| y l IH]; intros N; [reflexivity |].
    inversion_clear N as [| ? ? NI ND].
    change (count (times (d y) (generator y : deltas)) x +
            count (sum l (fun y => times (d y) (generator y : deltas))) x =
            if in_dec eq_dec x (y :: l) then d x else 0).
    rewrite count_times, (IH ND). cbn -[in_dec Z.mul].
    destruct (in_dec eq_dec x l), (in_dec eq_dec x (y :: l)); destruct (eq_dec y x); subst; cbn in *; try tauto; lia. }
  etransitivity; [apply K, NoDup_nodup |]. destruct (in_dec eq_dec x _) as [I | I]; [reflexivity |].
  rewrite nodup_In in I. destruct (Z.eq_dec (d x) 0); [congruence |]. now destruct I; apply delta_supported.
Qed.

(** Any map from the atoms into an abelian group extends to exactly one homomorphism. *)
Theorem universal_property : forall (G : abelian_group) (f : Atom -> G),
  exists h : delta -> G, (homomorphism deltas G h /\ forall x, h (generator x) =G f x) /\
    forall h' : delta -> G, homomorphism deltas G h' -> (forall x, h' (generator x) =G f x) -> forall d, h' d =G h d.
Proof.
  intros G f. exists (extend G f). split; [split; [apply extend_is_a_homomorphism | apply extend_generator] |].
  intros h' H F d. rewrite <- (proj1 H _ _ (delta_is_the_sum_of_its_generators d)).
  unfold extend at 1. rewrite (hom_sum deltas G h' H). apply sum_equal. intros x _.
  now rewrite (hom_times deltas G h' H), F.
Qed.

(** ** Events among the deltas *)

Program Definition embed (e : event Atom) : delta :=
  {| count := fun x => to_Z (e x); delta_support := support e |}.
Next Obligation. apply (supported e). intros E. now rewrite E in H. Qed.
Program Definition clamped (d : delta) : event Atom :=
  {| value := fun x => clamp (d x); support := delta_support d |}.
Next Obligation. apply delta_supported. intros E. now rewrite E in H. Qed.

Theorem clamp_retracts_the_embedding : forall e, same (clamped (embed e)) e.
Proof. intros e x; cbn. apply clamp_to_Z. Qed.

Theorem embedding_is_injective : forall e f, delta_same (embed e) (embed f) -> same e f.
Proof. intros e f H x. apply to_Z_injective, (H x). Qed.

Theorem image_of_the_embedding : forall d : delta, (forall x, -1 <= d x <= 1) <-> delta_same (embed (clamped d)) d.
Proof.
  intros d; split.
  - intros H x; cbn. now apply to_Z_clamp.
  - intros H x. rewrite <- (H x); cbn. destruct (clamp (d x)); cbn; lia.
Qed.

Theorem compose_is_the_clamped_sum : forall e f, same (compose e f) (clamped (add (embed e) (embed f))).
Proof. intros e f x; reflexivity. Qed.

Theorem embedding_is_no_homomorphism : forall x : Atom,
  ~ forall e f, delta_same (embed (compose e f)) (add (embed e) (embed f)).
Proof.
  intros x H. specialize (H (addition Atom eq_dec x) (addition Atom eq_dec x) x). cbn in H.
  now destruct (eq_dec x x).
Qed.

Theorem clamp_is_no_homomorphism : forall x : Atom,
  ~ forall d e, same (clamped (add d e)) (compose (clamped d) (clamped e)).
Proof.
  intros x H. specialize (H (scale 2 (generator x)) (scale (-1) (generator x)) x). cbn in H.
  now destruct (eq_dec x x).
Qed.

End Deltas.

Arguments count {Atom}.
Arguments delta_same {Atom}.
Arguments zero {Atom}.
Arguments add {Atom}.
Arguments embed {Atom}.
Arguments clamped {Atom}.
