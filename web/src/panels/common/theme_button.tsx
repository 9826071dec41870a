import { theme } from '../../state/theme';
import { appText } from '../../text/app_text';

/** Light, dark, or as the system has it. */
export function ThemeButton() {
  const choice = theme.choice.value;
  return (
    <button
      type="button"
      class="theme-button"
      data-testid="theme"
      data-choice={choice}
      aria-label={appText.theme[choice]}
      title={appText.theme[choice]}
      onClick={() => theme.next()}
    >
      <ThemeIcon choice={choice} />
    </button>
  );
}

function ThemeIcon({ choice }: { choice: keyof typeof appText.theme }) {
  return (
    <svg viewBox="0 0 20 20" aria-hidden="true">
      {choice === 'light' && (
        <path
          d="M10 1v3M10 16v3M1 10h3M16 10h3M3.6 3.6l2.1 2.1M14.3 14.3l2.1 2.1M16.4 3.6l-2.1 2.1M5.7 14.3l-2.1 2.1M10 6a4 4 0 1 0 0 8 4 4 0 0 0 0-8z"
          fill="none"
          stroke="currentcolor"
          stroke-width="1.6"
        />
      )}
      {choice === 'dark' && <path d="M16.5 12.5A7.5 7.5 0 0 1 7.5 2.6a7.5 7.5 0 1 0 9 9.9z" fill="currentcolor" />}
      {choice === 'system' && (
        <path d="M10 2a8 8 0 1 0 0 16 8 8 0 0 0 0-16zm0 1.8v12.4a6.2 6.2 0 0 1 0-12.4z" fill="currentcolor" />
      )}
    </svg>
  );
}
