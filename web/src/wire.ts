// The service's messages under short names. The shapes themselves are generated: see api.ts.
import type { components } from "./api";

type Schemas = components["schemas"];

export type ConsideredList = Schemas["ConsideredList"];
export type Experiment = Schemas["Experiment"];
export type ExperimentCreate = Schemas["ExperimentCreate"];
export type ExperimentPage = Schemas["ExperimentPage"];
export type ExperimentUpdate = Schemas["ExperimentUpdate"];
export type Lifecycle = Schemas["Lifecycle"];
export type Mode = Schemas["Mode"];
export type Proposal = Schemas["Proposal"];
export type Aggregation = Schemas["Aggregation"];
export type Looked = Schemas["Looked"];
export type Judge = Schemas["Judge"];
export type Together = Schemas["Together"];
export type SceneInfo = Schemas["SceneInfo"];
export type TrainerFigures = Schemas["TrainerFigures"];
export type Telemetry = Schemas["Telemetry"];
export type GuideState = Schemas["GuideState"];
export type GuideStep = Schemas["GuideStep"];
export type GuideOutcome = Schemas["GuideOutcome"];
export type Incident = Schemas["Incident"];
export type Reported = Schemas["ReportCreate"]["outcome"];
export type View = Schemas["View"];
export type Overlay = Schemas["Overlay"];
export type Feedback = Schemas["Feedback"];
export type Execution = Schemas["Execution"];
export type MetricPoint = Schemas["MetricPoint"];
export type MetricPage = Schemas["MetricPage"];
export type Evaluation = Schemas["Evaluation"];
export type Calibration = Schemas["Calibration"];
export type AutoApproval = Schemas["AutoApproval"];
export type AutoApprovalRecord = Schemas["AutoApprovalRecord"];
export type LabelQuality = Schemas["LabelQuality"];
export type PracticeCard = Schemas["PracticeCard"];
export type PracticeProgress = Schemas["PracticeProgress"];
export type PracticeReason = Schemas["PracticeReason"];
export type PracticeResult = Schemas["PracticeResult"];
export type PracticeSlip = Schemas["PracticeSlip"];
export type CriticMap = Schemas["CriticMap"];
export type HistoryEntry = Schemas["HistoryEntry"];
export type HistoryPage = Schemas["HistoryPage"];
export type Episode = Schemas["Episode"];
export type Stretch = Schemas["Stretch"];
export type TimelineInfo = Schemas["Timeline"];
export type TagInfo = Schemas["TagInfo"];
export type Curves = Schemas["Curves"];
export type ChartInfo = Schemas["Chart"];
export type CurveInfo = Schemas["Curve"];
export type Comparison = Schemas["Comparison"];
export type Measure = Comparison["measure"];
export type PaperFigures = Schemas["PaperFigures"];
export type TaskInfo = Schemas["TaskInfo"];
export type AdapterInfo = Schemas["AdapterInfo"];
export type AlgorithmInfo = Schemas["AlgorithmInfo"];
export type TeacherInfo = Schemas["TeacherInfo"];
export type Problem = Schemas["Problem"];
export type FrameHeader = Schemas["FrameHeader"];

/** Only the connection itself needs the events' numbers. */
type Numbered<Event> = Event extends { seq: number | null }
  ? Omit<Event, "seq"> & Partial<Pick<Event, "seq">>
  : never;

export type StreamEvent = Numbered<
  | Schemas["Snapshot"]
  | Schemas["Resumed"]
  | Schemas["ExperimentChanged"]
  | Schemas["ProposalOpened"]
  | Schemas["ProposalChanged"]
  | Schemas["ProposalClosed"]
  | Schemas["JudgesChanged"]
  | Schemas["FeedbackStored"]
  | Schemas["FeedbackUndone"]
  | Schemas["FeedbackRelabelled"]
  | Schemas["ExecutionStarted"]
  | Schemas["ExecutionEnded"]
  | Schemas["MetricsAdded"]
  | Schemas["WorkerChanged"]
  | Schemas["RobotTold"]
  | Schemas["AttendanceChanged"]
  | Schemas["IncidentKept"]
  | Schemas["EvaluationChanged"]
  | Schemas["Acknowledged"]
  | Schemas["Refused"]
  | Schemas["Pong"]
>;

export type ClientMessage =
  | Schemas["ClientFeedback"]
  | Schemas["ClientLook"]
  | Schemas["ClientRelabel"]
  | Schemas["ClientUndo"]
  | Schemas["ClientHalt"]
  | Schemas["ClientFrameAck"]
  | Schemas["ClientPing"];

/** −1 bad, 0 neutral, +1 good, or that nothing can be told from the view. */
export type Value = Schemas["Feedback"]["value"];

export type Verb = "start" | "pause" | "resume" | "finish" | "reset" | "halt" | "rearm";

export type StudySummary = Schemas["StudySummary"];
export type Study = Schemas["Study"];
export type StudyRun = Schemas["StudyRun"];
export type StudyScenario = Schemas["StudyScenario"];

export type Me = Schemas["Me"];
export type Role = Schemas["Role"];
export type SignedIn = Schemas["SignedIn"];
export type Person = Schemas["Person"];
export type Invitation = Schemas["Invitation"];
export type InvitationCreate = Schemas["InvitationCreate"];
export type InvitationMade = Schemas["InvitationMade"];
