p{
  "id": 2011030100100,
  "name": "SoccerPlay",
  "comment": "",
  "masterPlan": false,
  "utilityThreshold": 0.1,
  "minCardinality": 2,
  "maxCardinality": 5,
  "preCondition": null,
  "runtimeCondition": null,
  "entryPoints": [
    {
      "id": 2011030100110,
      "name": "Attack",
      "comment": "",
      "minCardinality": 1,
      "maxCardinality": 1,
      "successRequired": false,
      "task": "soccer.tsk#2011030200001",
      "state": 2011030100120,
      "plan": 2011030100100
    },
    {
      "id": 2011030100111,
      "name": "Defend",
      "comment": "",
      "minCardinality": 1,
      "maxCardinality": 2,
      "successRequired": false,
      "task": "soccer.tsk#2011030200002",
      "state": 2011030100121,
      "plan": 2011030100100
    },
    {
      "id": 2011030100112,
      "name": "Support",
      "comment": "",
      "minCardinality": 0,
      "maxCardinality": 2,
      "successRequired": false,
      "task": "soccer.tsk#2011030200003",
      "state": 2011030100122,
      "plan": 2011030100100
    }
  ],
  "states": [
    {
      "id": 2011030100120,
      "name": "GetBall",
      "comment": "",
      "type": "State",
      "entryPoint": 2011030100110,
      "parentPlan": 2011030100100,
      "confAbstractPlanWrappers": [],
      "inTransitions": [],
      "outTransitions": [],
      "variableBindings": []
    },
    {
      "id": 2011030100121,
      "name": "ProtectGoal",
      "comment": "",
      "type": "State",
      "entryPoint": 2011030100111,
      "parentPlan": 2011030100100,
      "confAbstractPlanWrappers": [],
      "inTransitions": [],
      "outTransitions": [],
      "variableBindings": []
    },
    {
      "id": 2011030100122,
      "name": "OfferPass",
      "comment": "",
      "type": "State",
      "entryPoint": 2011030100112,
      "parentPlan": 2011030100100,
      "confAbstractPlanWrappers": [],
      "inTransitions": [],
      "outTransitions": [],
      "variableBindings": []
    }
  ],
  "transitions": [],
  "synchronisations": [],
  "variables": []
}
