/** What the REST interface sends and takes, as proto/openapi.yaml has it, and types taken from it. */
import type * as wire from './generated/openapi';

export type {
  AccountRole,
  Annotation,
  Answer,
  AssessedPlan,
  Band,
  Benchmark,
  BenchmarkSummary,
  BonePart,
  BuildSettings,
  Case,
  CaseBuilt,
  CaseCt,
  CaseSegmentation,
  CaseStage,
  CaseSummary,
  ChoiceItem,
  Experience,
  FeelAnswer,
  FeelComparison,
  FeelPlace,
  FeelReport,
  FeelTrial,
  GivenAnswers,
  Job,
  KeptRubric,
  KnownMetric,
  Landmarks,
  Learning,
  Limits,
  LikertItem,
  Link as ViewerLink,
  Login,
  Mark,
  Measures,
  Metrics,
  NewBenchmark,
  NewCase,
  NewFeelTrials,
  NewParticipant,
  NewPlan,
  NewQuestionnaire,
  NewQuestionnaireItem,
  NewRater,
  NewStudy,
  NewStudyDesign,
  NextSession,
  NewUser,
  NormalValue,
  Outcome,
  Participant,
  Plan,
  PlanAssessment,
  PlanOutcome,
  PlanPrediction,
  PlanTargets,
  PlateName,
  PlaybackChange,
  Point as Triple,
  Questionnaire,
  QuestionnaireItem,
  QueuedRating,
  Rater,
  Reamer,
  Replay,
  Role,
  Rubric,
  SampleSize,
  Score,
  ScoredMetric,
  SegmentationSettings,
  Session,
  SessionChange,
  Side,
  Study,
  StudyDesign,
  StudyPhase,
  TextItem,
  Times,
  Token,
  Upload,
  User,
  UserChange,
  ValidityReport,
  Verdict,
} from './generated/openapi';

/** Every setting with a value. */
export type FullSegmentationSettings = Required<wire.SegmentationSettings>;
export type Guide = wire.Plan['guide'];
export type WalchClass = NonNullable<wire.Landmarks['walch']>;
export type SeedName = keyof NonNullable<wire.SegmentationSettings['seeds']>;
/** One page of the list of sessions. */
export type SessionPage = Pick<wire.SessionList, 'sessions' | 'next' | 'total'>;
/** What a study's size depends on, and the question that it is to answer. */
export type SampleInput = wire.operations['getSampleSize']['parameters']['query'];
export type SampleQuestion = SampleInput['question'];
export type RubricSummary = wire.RubricList['rubrics'][number];
export type Criterion = wire.Rubric['criteria'][number];
export type Person = wire.PersonList['persons'][number];

export const accountRoles: readonly wire.AccountRole[] = ['operator', 'instructor', 'trainee'];
export const experiences: readonly wire.Experience[] = ['novice', 'intermediate', 'expert'];
export const walchClasses: readonly WalchClass[] = ['A1', 'A2', 'B1', 'B2', 'B3', 'C1', 'C2', 'D'];
