export type Experience = 'novice' | 'intermediate' | 'expert';
export const experiences: readonly Experience[] = ['novice', 'intermediate', 'expert'];

export interface LikertItem {
  kind: 'likert';
  id: string;
  section: string;
  words: string;
  required: boolean;
  points: 5 | 7;
  low: string;
  high: string;
  cannot_judge: boolean;
}

export interface ChoiceItem {
  kind: 'choice';
  id: string;
  section: string;
  words: string;
  required: boolean;
  options: { id: string; words: string }[];
  several: boolean;
}

export interface TextItem {
  kind: 'text';
  id: string;
  section: string;
  words: string;
  required: boolean;
  /** Characters. */
  longest: number;
}

export type Item = LikertItem | ChoiceItem | TextItem;

export interface Questionnaire {
  id: string;
  title: string;
  introduction: string;
  language: string;
  items: Item[];
}

/** By item id: points, or null for cannot judge; an option's id, or several; a text. */
export type Answer = number | null | string | string[];
export type Answers = Record<string, Answer>;

export interface Study {
  id: string;
  name: string;
  description: string;
  state: 'open' | 'closed';
  blinded: boolean;
  created_utc: string;
  cases: string[];
  script: string | null;
  device: string | null;
  device_profile: string | null;
  /** Null for who does not run studies. */
  join_code: string | null;
  participants: number | null;
  /** The user's own code; null: does not take part. */
  participant: string | null;
  /** Absent in lists. */
  questionnaire?: Questionnaire | null;
}

export interface NewStudy {
  name: string;
  description: string;
  cases: string[];
  device?: string;
  script?: string;
  /** Absent: the one that comes with the program; null: none. */
  questionnaire?: object | null;
}

export interface Participant {
  code: string;
  /** Null where the user may not know it yet. */
  experience: Experience | null;
  procedures_done: number | null;
  answers: Answers | null;
  /** Logs in, and answers themself. */
  has_account: boolean;
}

export interface NewParticipant {
  experience: Experience;
  procedures_done: number;
  user_id?: string;
  name?: string;
}

/** Who is behind a code. */
export interface Person {
  code: string;
  user_id: string | null;
  name: string;
}

export type ExportTable = 'sessions' | 'answers' | 'groups';
