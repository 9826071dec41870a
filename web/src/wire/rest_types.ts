/** What the REST interface sends and takes, as proto/openapi.yaml has it, under the names of the page. */
import type * as wire from './generated/openapi';

export type {
  AccountRole,
  Annotation,
  Answer,
  AssessedPlan,
  Band,
  CaseSummary,
  ChoiceItem,
  Experience,
  Job,
  Landmarks,
  Learning,
  LikertItem,
  Mark,
  Measures,
  Metrics,
  NewCase,
  NewParticipant,
  NewPlan,
  NewStudy,
  NewUser,
  Outcome,
  Participant,
  Plan,
  PlaybackChange,
  Questionnaire,
  Reamer,
  Replay,
  Role,
  Score,
  ScoredMetric,
  SegmentationSettings,
  Session,
  SessionChange,
  Side,
  Standing,
  Study,
  TextItem,
  Token,
  Upload,
  User,
  UserChange,
  Verdict,
} from './generated/openapi';
export type {
  BonePart,
  BuildSettings as BuildSettings,
  Case as CaseDetails,
  CaseBuilt as BuiltBone,
  CaseCt as CtDescription,
  CaseSegmentation as Segmentation,
  CaseStage as Stage,
  DeviceLink as DeviceHealth,
  GivenAnswers as Answers,
  Link as ViewerLink,
  Login as Visitor,
  NormalValue as NormalRange,
  PlanAssessment as Assessment,
  PlanTargets as PlanTargets,
  Point as Triple,
  QuestionnaireItem as Item,
  Times as Timing,
} from './generated/openapi';

/** All settings, each as it is wanted. */
export type WantedSettings = Required<wire.SegmentationSettings>;
export type Guide = wire.Plan['guide'];
export type HumeralHead = NonNullable<wire.Landmarks['humeral_head']>;
export type WalchClass = NonNullable<wire.Landmarks['walch']>;
/** Landmarks that are points, by their keys. */
export type PointName = Exclude<keyof wire.Landmarks, 'humeral_head' | 'biconcavity_mm' | 'walch'>;
export type SeedName = keyof NonNullable<wire.SegmentationSettings['seeds']>;
export type LearningSession = wire.Learning['sessions'][number];
/** One page of the list of sessions. */
export type SessionPage = Pick<wire.SessionList, 'sessions' | 'next' | 'total'>;
export type Person = wire.PersonList['persons'][number];

export const accountRoles: readonly wire.AccountRole[] = ['operator', 'instructor', 'trainee'];
export const experiences: readonly wire.Experience[] = ['novice', 'intermediate', 'expert'];
export const walchClasses: readonly WalchClass[] = ['A1', 'A2', 'B1', 'B2', 'B3', 'C1', 'C2', 'D'];
