import { computed, effect, signal } from '@preact/signals';

export type ThemeChoice = 'system' | 'light' | 'dark';
const choices: readonly ThemeChoice[] = ['system', 'light', 'dark'];
const key = 'ream.theme';

type Kept = Pick<Storage, 'getItem' | 'setItem'>;
type Scheme = Pick<MediaQueryList, 'matches' | 'addEventListener'>;

/** Light or dark, as the system has it or as was chosen on this computer. */
export class Theme {
  readonly choice = signal<ThemeChoice>('system');
  private readonly systemDark = signal(false);
  readonly shown = computed(() =>
    this.choice.value === 'system' ? (this.systemDark.value ? 'dark' : 'light') : this.choice.value,
  );

  /** Takes up what was chosen last and follows the system; `show` is called now and at every change. */
  begin(storage: Kept, darkScheme: Scheme, show: (theme: 'light' | 'dark') => void): void {
    const kept = keptIn(storage);
    this.choice.value = choices.find((one) => one === kept) ?? 'system';
    this.systemDark.value = darkScheme.matches;
    darkScheme.addEventListener('change', () => (this.systemDark.value = darkScheme.matches));
    effect(() => show(this.shown.value));
    effect(() => {
      try {
        storage.setItem(key, this.choice.value);
      } catch {
        // A browser that keeps nothing still shows what was chosen.
      }
    });
  }

  next(): void {
    this.choice.value = choices[(choices.indexOf(this.choice.value) + 1) % choices.length] ?? 'system';
  }
}

function keptIn(storage: Kept): string | null {
  try {
    return storage.getItem(key);
  } catch {
    return null;
  }
}

/** The page's; pictures that are drawn with its colours are drawn anew when it changes. */
export const theme = new Theme();
