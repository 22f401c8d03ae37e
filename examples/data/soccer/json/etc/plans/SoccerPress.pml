{
  "id": 2011030100200,
  "name": "SoccerPress",
  "comment": "",
  "masterPlan": false,
  "utilityThreshold": 0.1,
  "minCardinality": 3,
  "maxCardinality": 5,
  "preCondition": null,
  "runtimeCondition": null,
  "entryPoints": [
    {
      "id": 2011030100210,
      "name": "Attack",
      "comment": "",
      "minCardinality": 2,
      "maxCardinality": 2,
      "successRequired": false,
      "task": "soccer.tsk#2011030200001",
      "state": 2011030100220,
      "plan": 2011030100200
    },
    {
      "id": 2011030100211,
      "name": "Defend",
      "comment": "",
      "minCardinality": 1,
      "maxCardinality": 1,
      "successRequired": false,
      "task": "soccer.tsk#2011030200002",
      "state": 2011030100221,
      "plan": 2011030100200
    },
    {
      "id": 2011030100212,
      "name": "Support",
      "comment": "",
      "minCardinality": 0,
      "maxCardinality": 2,
      "successRequired": false,
      "task": "soccer.tsk#2011030200003",
      "state": 2011030100222,
      "plan": 2011030100200
    }
  ],
  "states": [
    {
      "id": 2011030100220,
      "name": "CloseIn",
      "comment": "",
      "type": "State",
      "entryPoint": 2011030100210,
      "parentPlan": 2011030100200,
      "confAbstractPlanWrappers": [],
      "inTransitions": [],
      "outTransitions": [],
      "variableBindings": []
    },
    {
      "id": 2011030100221,
      "name": "ProtectGoal",
      "comment": "",
      "type": "State",
      "entryPoint": 2011030100211,
      "parentPlan": 2011030100200,
      "confAbstractPlanWrappers": [],
      "inTransitions": [],
      "outTransitions": [],
      "variableBindings": []
    },
    {
      "id": 2011030100222,
      "name": "BlockLane",
      "comment": "",
      "type": "State",
      "entryPoint": 2011030100212,
      "parentPlan": 2011030100200,
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
