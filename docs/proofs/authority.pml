/* Who rules one plan type: the authority protocol of team/authority.hpp and team/robot.hpp, for spin. docs/proofs/spin runs it.
 *
 * Robots 0, 1, 2; a greater number is a greater stamp. Comments name the functions of the code.
 *
 * What is abstracted:
 * - Time. A detection begins a cascade; an answer belongs to the cascade of the claim that it answers, so it inherits its end.
 *   At some moment a cascade rings: its first reign is over by its leader's clock. From then on each robot ends what it knows
 *   of the cascade at a moment of its own, early or late. Delays are unbounded.
 * - The radio. A claim that was made may arrive anywhere, at any later time, any number of times, in any order, or never.
 *   Of plan messages, what the sender would say now may arrive anywhere at any time, or never; and one that was said earlier.
 * - Lives. (incarnation, number) is one growing number: a restart with a greater incarnation forgets all and keeps counting,
 *   and its first plan message says that everything before is over.
 * - Detection. Any robot that nobody rules may detect, and any leader may renew its reign, `detections` times in all. A renewal begins
 *   a cascade of its own; stamps stay the same, so who obeys a renewal never answers it. What befalls the robots (leaving, a restart,
 *   silence, blindness) happens `troubles` times in all; coming back is free.
 * Left out: allocations and versions, changing confidence, wrong clocks, forged messages, restarts with an old incarnation. */

#ifndef DETECTIONS
#define DETECTIONS 2
#endif
#ifndef TROUBLES
#define TROUBLES 2
#endif
#ifndef LATE
#define LATE 1 /* so many plan messages arrive after others that were said later */
#endif
#define ROBOTS 3
#define MOST 7 /* claims of one robot: an assertion says that there are never more, so nothing is cut off */

#define none 0
#define leading 1
#define obeying 2

/* Arrays of two indices: what i knows of j; claim n of j. */
#define ON(i, j) ((i) * ROBOTS + (j))
#define CLAIM(j, n) ((j) * (MOST + 1) + (n))

bool executes[ROBOTS];
byte phase[ROBOTS];                   /* authority::phase_ */
byte leader[ROBOTS], number[ROBOTS];  /* the claim in force; 0, 0 if there is none */
byte made[ROBOTS];                    /* robot::claims_ */
byte cascade[ROBOTS * (MOST + 1)];    /* of each claim: 1, 2, ...; 0: not made yet */
bool rung[DETECTIONS + 1];
byte last[ROBOTS * ROBOTS];           /* authority::known: the last claim heard of each leader */
bool over[ROBOTS * ROBOTS];           /* ... has ended here, by this robot's clock or by its leader's word */
bool answered[ROBOTS * ROBOTS];       /* ... was answered by this robot */
byte detections, troubles;

/* A plan message that arrives late. Who has heard a later one of its sender drops it. */
byte late_left = LATE;
bool late_there, late_executes, late_stale[ROBOTS];
byte late_from, late_made, late_leads;

#ifdef GHOSTS /* what an observer notes; only assertions read it */
byte ended[ROBOTS * ROBOTS];           /* the greatest number of j whose end i has known */
byte claimed_against[ROBOTS * ROBOTS];   /* bit n: i has answered claim n of j */
#endif

/* The order of the stamps of claim n of j and claim m of k; whether i would claim with a greater stamp than claim n of j. */
#ifdef BROKEN_THAW /* a stamp is computed anew for each claim, and by then i has grown more confident */
#define SMALLER(j, n, k, m) ((n) < (m) || ((n) == (m) && (j) < (k)))
#define MINE_IS_GREATER(i, j, n) (made[i] + 1 > (n) || (made[i] + 1 == (n) && (j) < (i)))
#else
#define SMALLER(j, n, k, m) ((j) < (k))
#define MINE_IS_GREATER(i, j, n) ((j) < (i))
#endif

inline nobody(whom) {
  phase[whom] = none;
  leader[whom] = 0;
  number[whom] = 0
}

/* authority::lead */
inline lead(claimer, belongs_to) {
  made[claimer]++;
  assert(made[claimer] <= MOST); /* BOUNDED: from a detection follow so many claims at most */
  cascade[CLAIM(claimer, made[claimer])] = belongs_to;
  phase[claimer] = leading;
  leader[claimer] = claimer;
  number[claimer] = made[claimer]
}

/* known::over: the robot knows the end of the last claim that it heard of this leader */
inline know_over(knower, of_leader) {
#ifndef BROKEN_REVIVAL /* what has ended is forgotten, its end too */
  over[ON(knower, of_leader)] = true;
  answered[ON(knower, of_leader)] = false; /* never asked for again */
#endif
#ifdef GHOSTS
  if
  :: last[ON(knower, of_leader)] > ended[ON(knower, of_leader)] -> ended[ON(knower, of_leader)] = last[ON(knower, of_leader)]
  :: else
  fi;
#endif
  if
  :: phase[knower] == obeying && leader[knower] == of_leader -> nobody(knower)
  :: else
  fi
}

/* authority::hear: a robot hears a claim */
inline hear(hearer, claimant, claimed) {
  if
  :: executes[hearer] && claimed >= last[ON(hearer, claimant)] ->
    if
    :: claimed > last[ON(hearer, claimant)] ->
      last[ON(hearer, claimant)] = claimed;
      over[ON(hearer, claimant)] = false;
      answered[ON(hearer, claimant)] = false;
      if
      :: phase[hearer] == obeying && leader[hearer] == claimant -> nobody(hearer)
      :: else
      fi
    :: else
    fi;
    if
    :: over[ON(hearer, claimant)] -> skip                            /* claim_outcome::expired */
    :: else -> judge(hearer, claimant, claimed)
    fi
  :: else
  fi
}

/* authority::judge */
inline judge(judger, rival, bid) {
  if
  :: phase[judger] != none && leader[judger] == rival -> skip        /* repeated */
#ifndef BROKEN_SMALLER /* whoever speaks is obeyed */
  :: phase[judger] != none && leader[judger] != rival && SMALLER(rival, bid, leader[judger], number[judger]) ->
    skip                                                             /* outranked */
#endif
  :: phase[judger] == none && MINE_IS_GREATER(judger, rival, bid) && !answered[ON(judger, rival)] -> /* challenged */
#ifdef GHOSTS
    assert((claimed_against[ON(judger, rival)] & (1 << bid)) == 0); /* ONCE: a robot answers a claim at most once */
    claimed_against[ON(judger, rival)] = claimed_against[ON(judger, rival)] | (1 << bid);
#endif
#ifndef BROKEN_ANSWER /* that it was answered is forgotten */
    answered[ON(judger, rival)] = true;
#endif
#ifdef BROKEN_BURIAL /* what was answered is never obeyed */
    over[ON(judger, rival)] = true;
#endif
    lead(judger, cascade[CLAIM(rival, bid)])
  :: else ->                                                         /* adopted */
    assert(phase[judger] != obeying || !SMALLER(rival, bid, leader[judger], number[judger])); /* GREATER: no turn to a smaller stamp */
#ifdef GHOSTS
    assert(bid > ended[ON(judger, rival)]); /* OVER: no claim is obeyed that the robot knew to be over */
#endif
#ifdef BROKEN_DEAF /* what is superseded is never obeyed again */
    if
    :: phase[judger] == obeying -> over[ON(judger, leader[judger])] = true
    :: else
    fi;
#endif
    phase[judger] = obeying;
    leader[judger] = rival;
    number[judger] = bid
  fi
}

/* robot::receive of a plan message: authority::hear_over, then track::dismiss of who does not execute the type */
hidden byte said_made, said_leads; /* what the message says; set and read in one step */
hidden byte said_executes;
inline hear_plan(told, sender) {
#ifndef BROKEN_SILENT /* plan messages do not say which claims are over */
  if
  :: last[ON(told, sender)] != 0 && !over[ON(told, sender)] && last[ON(told, sender)] <= said_made &&
     last[ON(told, sender)] > said_leads -> know_over(told, sender)
  :: else
  fi;
#endif
  if
  :: !said_executes && phase[told] == obeying && leader[told] == sender -> nobody(told)
  :: else
  fi
}

/* A robot hears what another would say now. */
#define LEADS(j) (phase[j] == leading -> number[j] : 0)
inline hear_now(listener, speaker) {
  said_made = made[speaker];
  said_leads = LEADS(speaker);
  said_executes = executes[speaker];
  hear_plan(listener, speaker);
  if
  :: late_there && late_from == speaker -> late_stale[listener] = true
  :: else
  fi
}

/* Robot i can end what it knows of j; its own reign. */
#define CAN_END(i, j) (last[ON(i, j)] != 0 && !over[ON(i, j)] && rung[cascade[CLAIM(j, last[ON(i, j)])]])
#define CAN_END_OWN(i) (phase[i] == leading && rung[cascade[CLAIM(i, number[i])]])

/* What a robot does sooner or later: it ends what it can end, and otherwise speaks so that all others hear it. */
proctype Robot(byte me) {
  byte j;
  do
  :: d_step {
    if
    :: CAN_END_OWN(me) -> nobody(me)
    :: !CAN_END_OWN(me) && CAN_END(me, 0) -> know_over(me, 0)
    :: !CAN_END_OWN(me) && !CAN_END(me, 0) && CAN_END(me, 1) -> know_over(me, 1)
    :: !CAN_END_OWN(me) && !CAN_END(me, 0) && !CAN_END(me, 1) && CAN_END(me, 2) -> know_over(me, 2)
    :: else ->
      for (j : 0 .. ROBOTS - 1) {
        if
        :: j != me ->
          hear_now(j, me);
          if
          :: phase[me] == leading -> hear(j, me, number[me])
          :: else
          fi
        :: else
        fi
      }
    fi;
    j = 0
  }
  od
}

#ifndef ENDLESS
/* The first reign of a cascade is over by its leader's clock. */
proctype Clock() {
  do
  :: detections >= 1 && !rung[1] -> rung[1] = true
#if DETECTIONS > 1
  :: detections >= 2 && !rung[2] -> rung[2] = true
#endif
#if DETECTIONS > 2
  :: detections >= 3 && !rung[3] -> rung[3] = true
#endif
  od
}
#endif

/* What may happen at any time, or never. */
proctype Chance() {
  byte i, j, n;
  do
  :: atomic {
    if :: i = 0 :: i = 1 :: i = 2 fi;
    if :: j = 0 :: j = 1 :: j = 2 fi;
    if
    :: i == j && executes[i] && phase[i] != obeying && detections < DETECTIONS -> /* robot::conclude: a conflict lasts; or renew */
      d_step {
        detections++;
        lead(i, detections)
      }
    :: i != j && made[j] != 0 -> /* a copy of a claim arrives */
      n = 1;
      do
      :: n < made[j] -> n++
      :: break
      od;
      skip; /* a loop may not end in a d_step */
      d_step { hear(i, j, n) }
    :: i != j -> d_step { hear_now(i, j) }
    :: i == j && late_left != 0 && !late_there -> /* a plan message is said that will arrive late */
      d_step {
        late_left--;
        late_there = true;
        late_from = i;
        late_made = made[i];
        late_leads = LEADS(i);
        late_executes = executes[i]
      }
    :: i != j && j == late_from && late_there && !late_stale[i] -> /* it arrives */
      d_step {
        said_made = late_made;
        said_leads = late_leads;
        said_executes = late_executes;
        hear_plan(i, late_from)
      }
    :: i == j && i == late_from && late_there -> /* it never arrives again */
      d_step {
        late_there = false; late_executes = false;
        late_from = 0; late_made = 0; late_leads = 0;
        late_stale[0] = false; late_stale[1] = false; late_stale[2] = false
      }
    :: i != j && CAN_END(i, j) -> d_step { know_over(i, j) }
    :: i == j && CAN_END_OWN(i) -> d_step { nobody(i) }
    :: i == j && !executes[i] -> executes[i] = true /* robot::enter */
    :: i == j && executes[i] && troubles < TROUBLES -> /* robot::leave */
      d_step {
        troubles++;
        executes[i] = false;
        nobody(i)
      }
    :: i == j && phase[i] != none && troubles < TROUBLES -> /* its leader is silent for too long; or it leads and goes blind */
      d_step {
        troubles++;
        nobody(i)
      }
    :: i == j && made[i] + last[ON(i, 0)] + last[ON(i, 1)] + last[ON(i, 2)] != 0 && troubles < TROUBLES -> /* a restart */
      d_step {
        troubles++;
        nobody(i);
        executes[i] = true;
        late_stale[i] = false;
        last[ON(i, 0)] = 0; over[ON(i, 0)] = false; answered[ON(i, 0)] = false;
        last[ON(i, 1)] = 0; over[ON(i, 1)] = false; answered[ON(i, 1)] = false;
        last[ON(i, 2)] = 0; over[ON(i, 2)] = false; answered[ON(i, 2)] = false
#ifdef GHOSTS
        ; ended[ON(i, 0)] = 0; ended[ON(i, 1)] = 0; ended[ON(i, 2)] = 0;
        claimed_against[ON(i, 0)] = 0; claimed_against[ON(i, 1)] = 0; claimed_against[ON(i, 2)] = 0
#endif
      }
    :: else
    fi;
    i = 0; j = 0; n = 0
  }
  od
}

init {
  atomic {
    executes[0] = true; executes[1] = true; executes[2] = true;
    run Robot(0); run Robot(1); run Robot(2);
    run Chance();
#ifndef ENDLESS
    run Clock()
#endif
  }
}

#define QUIET (phase[0] == none && phase[1] == none && phase[2] == none)
#define OBEYS(i, k) (!executes[i] || (phase[i] == obeying && leader[i] == k && number[i] == number[k]))
#define AGREED                                             \
  (QUIET || (phase[0] == leading && OBEYS(1, 0) && OBEYS(2, 0)) || \
   (phase[1] == leading && OBEYS(0, 1) && OBEYS(2, 1)) ||          \
   (phase[2] == leading && OBEYS(0, 2) && OBEYS(1, 2)))

ltl ends { <>[] QUIET }
ltl agree { <>[] AGREED } /* with ENDLESS: for as long as a reign lasts */
