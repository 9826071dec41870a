import { appText } from './app_text';

/** Fixed decimals, with a true minus sign; a dash for what is unknown. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return appText.none;
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? (0).toFixed(decimals) : text.replace('-', '−');
}

/** The server's words as a sentence. */
export function sentence(reason: string): string {
  if (reason === '') return '';
  const text = reason.charAt(0).toUpperCase() + reason.slice(1);
  return /[.!?…]$/.test(text) ? text : `${text}.`;
}

/** A moment of a session as minutes, seconds and tenths: "2:03.8". */
export function minutes(seconds: number): string {
  const tenths = Math.round(seconds * 10);
  return `${Math.floor(tenths / 600)}:${((tenths % 600) / 10).toFixed(1).padStart(4, '0')}`;
}

/** How long something took, with units: "37.5 s", "2 min 04 s", "1 h 02 min". */
export function duration(seconds: number): string {
  const tenths = Math.round(seconds * 10);
  if (tenths < 600) return `${(tenths / 10).toFixed(1)} s`;
  const whole = Math.round(seconds);
  const [h, min, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const two = (count: number) => String(count).padStart(2, '0');
  return h > 0 ? `${h} h ${two(min)} min` : `${min} min ${two(s)} s`;
}

/** A share from 0 to 1 in percent, rounded down: "100 %" is said only of what is complete. */
export function percent(share: number): string {
  return `${Math.min(Math.max(Math.floor(share * 100 + 1e-9), 0), 100)} %`;
}

/** Day and time of a moment as the server writes it, in the viewer's own time zone; with its year unless that is this year. */
export function dayAndTime(utc: string, now = new Date()): string {
  const at = new Date(utc);
  return inWords(at, at.getFullYear() !== now.getFullYear());
}

/** Day, year and time: of what lies ahead, where a reader cannot guess the year. */
export const dayYearAndTime = (utc: string): string => inWords(new Date(utc), true);

function inWords(at: Date, withYear: boolean): string {
  return at.toLocaleString(undefined, {
    day: 'numeric',
    month: 'short',
    year: withYear ? 'numeric' : undefined,
    hour: '2-digit',
    minute: '2-digit',
    hourCycle: 'h23',
  });
}

/** Hours, minutes and seconds of a wall-clock time. */
export function clock(ms: number): string {
  return new Date(ms).toLocaleTimeString(undefined, {
    hour: '2-digit',
    minute: '2-digit',
    second: '2-digit',
    hourCycle: 'h23',
  });
}
