import type { StudyLine as Line } from '../../state/study/study_line';
import { practiceText } from '../../text/practice_text';

/** Who takes part in a study sees that the session is one of it. */
export function StudyLine({ study }: { study: Line }) {
  const now = study.now.value;
  if (now === null) return null;
  const { name, participant, attempt } = now;
  const parts = [
    name === null ? practiceText.study : practiceText.studyNamed(name),
    participant,
    attempt === null ? '' : practiceText.attempt(attempt),
  ];
  return (
    <p class="study-line" data-testid="study-line">
      {parts.filter((part) => part !== '').join(' · ')}
    </p>
  );
}
