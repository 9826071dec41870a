import { dayAndTime } from '../../text/format';
import { dashboardText } from '../../text/dashboard_text';
import type { Session } from '../../wire/rest_types';

/** Nobody's hand: a scripted session counts for no trainee, whoever started it. */
export const isDemo = ({ device }: Pick<Session, 'device'>): boolean => device.name === 'script';

/** Whose session it is, in words. */
export function traineeLabel(session: Session): string {
  const { trainee, participant, title } = session;
  if (isDemo(session)) return dashboardText.scripted;
  if (trainee) return trainee;
  if (participant) return dashboardText.byParticipant(participant);
  return title || dashboardText.unnamed;
}

/** A session in one line: when, on what, and whose it is. */
export const sessionLabel = (session: Session): string =>
  [dayAndTime(session.created_utc), session.title || session.case, traineeLabel(session)].join(', ');
