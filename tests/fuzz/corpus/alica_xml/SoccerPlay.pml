p<?xml version="1.0" encoding="UTF-8"?>
<alica:Plan xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:alica="http:///de.uni_kassel.vs.cn" id="2011030100100" name="SoccerPlay" comment="" masterPlan="false" utilityFunction="" utilityThreshold="0.1" destinationPath="" priority="0.0" minCardinality="2" maxCardinality="5">
  <states id="2011030100120" name="GetBall" comment="" entryPoint="2011030100110"/>
  <states id="2011030100121" name="ProtectGoal" comment="" entryPoint="2011030100111"/>
  <states id="2011030100122" name="OfferPass" comment="" entryPoint="2011030100112"/>
  <entryPoints id="2011030100110" name="Attack" comment="" successRequired="false" minCardinality="1" maxCardinality="1">
    <task>../tasks/soccer.tsk#2011030200001</task>
    <state>#2011030100120</state>
  </entryPoints>
  <entryPoints id="2011030100111" name="Defend" comment="" successRequired="false" minCardinality="1" maxCardinality="2">
    <task>../tasks/soccer.tsk#2011030200002</task>
    <state>#2011030100121</state>
  </entryPoints>
  <entryPoints id="2011030100112" name="Support" comment="" successRequired="false" minCardinality="0" maxCardinality="2">
    <task>../tasks/soccer.tsk#2011030200003</task>
    <state>#2011030100122</state>
  </entryPoints>
</alica:Plan>
