<?xml version="1.0" encoding="UTF-8"?>
<alica:Plan xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:alica="http:///de.uni_kassel.vs.cn" id="2011030100200" name="SoccerPress" comment="" masterPlan="false" utilityFunction="" utilityThreshold="0.1" destinationPath="" priority="0.0" minCardinality="3" maxCardinality="5">
  <states id="2011030100220" name="CloseIn" comment="" entryPoint="2011030100210"/>
  <states id="2011030100221" name="ProtectGoal" comment="" entryPoint="2011030100211"/>
  <states id="2011030100222" name="BlockLane" comment="" entryPoint="2011030100212"/>
  <entryPoints id="2011030100210" name="Attack" comment="" successRequired="false" minCardinality="2" maxCardinality="2">
    <task>../tasks/soccer.tsk#2011030200001</task>
    <state>#2011030100220</state>
  </entryPoints>
  <entryPoints id="2011030100211" name="Defend" comment="" successRequired="false" minCardinality="1" maxCardinality="1">
    <task>../tasks/soccer.tsk#2011030200002</task>
    <state>#2011030100221</state>
  </entryPoints>
  <entryPoints id="2011030100212" name="Support" comment="" successRequired="false" minCardinality="0" maxCardinality="2">
    <task>../tasks/soccer.tsk#2011030200003</task>
    <state>#2011030100222</state>
  </entryPoints>
</alica:Plan>
