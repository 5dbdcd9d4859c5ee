// REST: JSON in and out; every failure becomes an `ApiError` that carries problem details with a remedy.
import { at } from "./base";
import { t } from "./i18n";
import { inWords } from "./i18n/said";
import { ME, may, signedOut } from "./me";
import type {
  AdapterInfo,
  Aggregation,
  AlgorithmInfo,
  AutoApproval,
  AutoApprovalRecord,
  Calibration,
  Comparison,
  ConsideredList,
  CriticMap,
  Curves,
  Episode,
  Evaluation,
  Execution,
  Experiment,
  ExperimentCreate,
  ExperimentPage,
  ExperimentUpdate,
  Feedback,
  GuideOutcome,
  GuideState,
  GuideStep,
  HistoryEntry,
  HistoryPage,
  Incident,
  Invitation,
  InvitationCreate,
  InvitationMade,
  LabelQuality,
  Measure,
  MetricPage,
  MetricPoint,
  Mode,
  PaperFigures,
  Person,
  PracticeCard,
  PracticeProgress,
  PracticeResult,
  Problem,
  Proposal,
  Reported,
  SignedIn,
  Study,
  StudySummary,
  TagInfo,
  TaskInfo,
  TeacherInfo,
  TimelineInfo,
  Together,
  TrainerFigures,
  Value,
  Verb,
} from "./wire";

const ROOT = at("/api/v1");
const HALT_PATIENCE_MS = 5000;

export class ApiError extends Error {
  constructor(readonly problem: Problem) {
    super(problem.detail);
  }
}

const unreachable = (): Problem => ({
  type: "about:blank",
  title: t("problem.noAnswerTitle"),
  status: 0,
  detail: t("problem.noAnswer"),
  remedy: t("problem.unreachable"),
  fields: [],
});

/** Any thrown value as problem details. */
export function problemOf(error: unknown): Problem {
  return error instanceof ApiError ? error.problem : unreachable();
}

async function problemFrom(response: Response): Promise<Problem> {
  const fallback: Problem = {
    type: "about:blank",
    title: response.statusText || t("problem.error"),
    status: response.status,
    detail: t("problem.answered", { status: response.status }),
    remedy: t("problem.log"),
    fields: [],
  };
  try {
    return inWords({ ...fallback, ...((await response.json()) as Partial<Problem>) });
  } catch {
    return fallback;
  }
}

async function request<T>(method: string, path: string, body?: unknown, within?: number): Promise<T> {
  let response: Response;
  try {
    response = await fetch(ROOT + path, {
      method,
      signal: within === undefined ? null : AbortSignal.timeout(within),
      headers: body === undefined ? {} : { "Content-Type": "application/json" },
      body: body === undefined ? null : JSON.stringify(body),
    });
  } catch {
    throw new ApiError(unreachable());
  }
  if (response.status === 401) signedOut();
  if (!response.ok) throw new ApiError(await problemFrom(response));
  return (response.status === 204 ? null : await response.json()) as T;
}

/** A list comes bare or as a page. */
async function list<T>(path: string): Promise<T[]> {
  const answer = await request<T[] | { items: T[] }>("GET", path);
  return Array.isArray(answer) ? answer : answer.items;
}

export interface Catalogue {
  tasks: TaskInfo[];
  adapters: AdapterInfo[];
  algorithms: AlgorithmInfo[];
  teachers: TeacherInfo[];
}

export const task = (name: string) => request<TaskInfo>("GET", `/tasks/${encodeURIComponent(name)}`);

export const adapterList = () => list<AdapterInfo>("/adapters");

export async function catalogue(): Promise<Catalogue> {
  const [tasks, adapters, algorithms, teachers] = await Promise.all([
    list<TaskInfo>("/tasks"),
    adapterList(),
    list<AlgorithmInfo>("/algorithms"),
    list<TeacherInfo>("/teachers"),
  ]);
  return { tasks, adapters, algorithms, teachers };
}

/** A page of the experiments that `listing` (its query) asks for. */
export const experiments = (listing: string, cursor: string | null) =>
  request<ExperimentPage>(
    "GET",
    `/experiments?limit=50${listing && `&${listing}`}${cursor ? `&cursor=${encodeURIComponent(cursor)}` : ""}`,
  );

/** A page of closed proposals with what was said of them and what came of it; `narrowed` is its query. */
export const told = (id: number, narrowed: string, cursor: string | null) =>
  request<HistoryPage>(
    "GET",
    `/experiments/${id}/history?limit=100${narrowed && `&${narrowed}`}${cursor ? `&cursor=${encodeURIComponent(cursor)}` : ""}`,
  );

/** How the labels of an experiment came in over time. */
export const timeline = (id: number) => request<TimelineInfo>("GET", `/experiments/${id}/timeline`);

/** Every step of an episode, oldest first. */
export async function steps(id: number, episode: number): Promise<HistoryEntry[]> {
  const found: HistoryEntry[] = [];
  let cursor: string | null = null;
  do {
    const page: HistoryPage = await told(id, `episode=${episode}&order=asc`, cursor);
    found.push(...page.items);
    cursor = page.next_cursor ?? null;
  } while (cursor);
  return found;
}

/** What the critic expects of a skill over the table, in a proposal's situation; `others` stay the same everywhere. */
export const critic = (proposalId: number, skill: string, others: Record<string, number>) => {
  const held = Object.entries(others).map(([name, value]) => ["other", `${name}=${value}`]);
  return request<CriticMap>(
    "GET",
    `/proposals/${proposalId}/critic?${new URLSearchParams([["skill", skill], ...held])}`,
  );
};

/** What the agent would do with each skill in a proposal's situation. */
export const considered = (proposalId: number) =>
  request<ConsideredList>("GET", `/proposals/${proposalId}/considered`);

export const episode = (id: number, number: number) =>
  request<Episode>("GET", `/experiments/${id}/episodes/${number}`);

export const curves = (id: number) => request<Curves>("GET", `/experiments/${id}/curves`);

export const comparison = (experiments: number[], measure: Measure, by: string[]) => {
  const query = new URLSearchParams([
    ...experiments.map((id) => ["experiment", String(id)]),
    ["measure", measure],
    ...by.map((each) => ["by", each]),
  ]);
  return request<Comparison>("GET", `/comparison?${query}`);
};

export const paperFigures = () => request<PaperFigures>("GET", "/paper-figures");

export const tags = () => request<TagInfo[]>("GET", "/tags");

export const setTags = (id: number, tags: string[]) =>
  request<Experiment>("PATCH", `/experiments/${id}`, { tags });

export const experiment = (id: number) => request<Experiment>("GET", `/experiments/${id}`);

export const createExperiment = (body: ExperimentCreate) => request<Experiment>("POST", "/experiments", body);

export const act = (id: number, verb: Verb) => request<Experiment>("POST", `/experiments/${id}/${verb}`);

/** Ask for the emergency stop once, and wait no longer than this for an answer. */
export const halt = (id: number) =>
  request<Experiment>("POST", `/experiments/${id}/halt`, undefined, HALT_PATIENCE_MS);

/** Somebody is at the real robot, for so many seconds unless it is said again. */
export const attend = (id: number, operator: string, seconds: number) =>
  request<unknown>("PUT", `/experiments/${id}/attendance`, { operator, seconds });

export const leave = (id: number, operator: string) =>
  request<null>("DELETE", `/experiments/${id}/attendance?operator=${encodeURIComponent(operator)}`);

export const tend = (id: number, what: "home" | "recover", operator: string) =>
  request<Experiment>("POST", `/experiments/${id}/${what}?operator=${encodeURIComponent(operator)}`);

/** One calibration of the robot's cameras, step by step. */
const guiding = (id: number) => `/experiments/${id}/camera-calibration`;

export const guideState = (id: number) => request<GuideState>("GET", guiding(id));

export const guide = (id: number, square_mm: number, wanted: number) =>
  request<GuideStep>("POST", guiding(id), { square_mm, wanted });

export const guideLook = (id: number, take: boolean) =>
  request<GuideStep>("POST", `${guiding(id)}/looks`, { take });

export const guideSolve = (id: number) => request<GuideOutcome>("POST", `${guiding(id)}/solution`);

export const guideStore = (id: number) => request<GuideOutcome>("PUT", guiding(id));

export const setMode = (id: number, mode: Mode) =>
  request<Experiment>("PATCH", `/experiments/${id}`, { mode });

/** Null turns it off. */
export const setAutoApproval = (id: number, rule: AutoApproval | null) =>
  request<Experiment>("PATCH", `/experiments/${id}`, { auto_approval: rule });

export interface TogetherChange {
  aggregation?: Aggregation;
  together?: Partial<Together>;
}

/** How several trainers' answers add up, and who judges what. */
export const setTogether = (id: number, change: TogetherChange) =>
  request<Experiment>("PATCH", `/experiments/${id}`, change);

export const calibration = (id: number) => request<Calibration>("GET", `/experiments/${id}/calibration`);

export const autoApproval = (id: number) =>
  request<AutoApprovalRecord>("GET", `/experiments/${id}/auto-approval`);

/** Everybody's figures, and how far they agree; null for those who may see their own only. */
export const labelQuality = async (id: number) =>
  may("operator") ? request<LabelQuality>("GET", `/experiments/${id}/quality`) : null;

/** Know the answer to a closed proposal. */
export const markGold = (proposalId: number, answer: -1 | 1) =>
  request<null>("PUT", `/proposals/${proposalId}/gold`, { answer, trainer: ME });

export type QualityChange = Pick<ExperimentUpdate, "gold_rate"> | Pick<ExperimentUpdate, "practice_required">;

/** The stream tells of what has changed. */
export const setQuality = (id: number, change: QualityChange) =>
  request<Experiment>("PATCH", `/experiments/${id}`, change);

/** Where the metrics can be had as a table. */
export const metricsTable = (id: number) => `${ROOT}/experiments/${id}/exports/metrics`;

/** Where the feedback can be had as a table. */
export const feedbackTable = (id: number, form: "csv" | "jsonl") =>
  `${ROOT}/experiments/${id}/exports/feedback?format=${form}`;

export const practiceProgress = (id: number) =>
  request<PracticeProgress>("GET", `/experiments/${id}/practice?trainer=${encodeURIComponent(ME)}`);

/** The practice proposal that waits; a new one where none does. */
export const nextPractice = (id: number) =>
  request<PracticeCard>("POST", `/experiments/${id}/practice`, { trainer: ME });

export const answerPractice = (cardId: number, answer: { click_id: string; value: Value }) =>
  request<PracticeResult>("POST", `/practice/${cardId}/answer`, { ...answer, trainer: ME });

export const evaluate = (id: number, rollouts: number) =>
  request<Evaluation>("POST", `/experiments/${id}/evaluate`, { rollouts });

export const newestEvaluation = async (id: number) =>
  (await list<Evaluation>(`/experiments/${id}/evaluations?limit=1`))[0] ?? null;

/** The newest proposals with what one said of them and what came of it, for the strip of the past. */
export const past = (id: number, most: number) =>
  Promise.all([
    list<Proposal>(`/experiments/${id}/proposals?limit=${most}`),
    list<Feedback>(`/experiments/${id}/feedback?limit=200&trainer=${encodeURIComponent(ME)}`),
    list<Execution>(`/experiments/${id}/executions?limit=${most}`),
  ]);

export const ownFigures = (id: number) =>
  request<TrainerFigures>("GET", `/experiments/${id}/quality/mine?trainer=${encodeURIComponent(ME)}`);

export const incidents = (id: number) => list<Incident>(`/experiments/${id}/incidents?limit=20`);

export const report = (executionId: number, reportId: string, outcome: Reported) =>
  request<Execution>("POST", `/executions/${executionId}/reports`, {
    report_id: reportId,
    outcome,
    trainer: ME,
  });

export const feedback = (feedbackId: number) =>
  request<Feedback>("GET", `/feedback/${feedbackId}?trainer=${encodeURIComponent(ME)}`);

export const relabel = (feedbackId: number, clickId: string, value: Value) =>
  request<Feedback>("POST", `/feedback/${feedbackId}/relabels`, { click_id: clickId, value, trainer: ME });

export const newestProposal = async (id: number) =>
  (await list<Proposal>(`/experiments/${id}/proposals?limit=1`))[0] ?? null;

/** Every metric point of an experiment, oldest first. */
export async function metrics(id: number): Promise<MetricPoint[]> {
  const points: MetricPoint[] = [];
  let cursor: string | null = null;
  do {
    const query: string = cursor ? `&cursor=${encodeURIComponent(cursor)}` : "";
    const page: MetricPage = await request<MetricPage>("GET", `/experiments/${id}/metrics?limit=200${query}`);
    points.push(...page.items);
    cursor = page.next_cursor ?? null;
  } while (cursor);
  return points;
}

/** Come in by an invitation's token, with a name, or by one's own. */
export const signIn = (token: string, name: string | null) =>
  request<SignedIn>("POST", "/sign-in", name === null ? { token } : { token, name });

export const signOut = () => request<null>("POST", "/sign-out");

export const people = () => list<Person>("/people?limit=200");

export const invitations = () => list<Invitation>("/invitations?limit=200");

export const invite = (body: Partial<InvitationCreate>) =>
  request<InvitationMade>("POST", "/invitations", body);

export const withdraw = (invitationId: number) => request<null>("DELETE", `/invitations/${invitationId}`);

export const letOut = (personId: number) => request<Person>("DELETE", `/people/${personId}`);

export const giveRole = (personId: number, role: Person["role"]) =>
  request<Person>("PATCH", `/people/${personId}`, { role });

/** Where the audit can be had as a table. */
export const auditTable = () => `${ROOT}/exports/audit`;

export const studies = () => request<StudySummary[]>("GET", "/studies");

export const study = (name: string) => request<Study>("GET", `/studies/${encodeURIComponent(name)}`);

/** Where a figure or table of a study can be had. */
export const studyFile = (name: string, file: string) =>
  `${ROOT}/studies/${encodeURIComponent(name)}/files/${encodeURIComponent(file)}`;
