import { useSignal } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';

import { sentence } from '../text/format';
import { useIdentity } from '../panels/common/site_nav';
import { appText } from '../text/app_text';
import { Button } from '../panels/common/button';

/** Asks for name and password, and says why. */
export function LoginPage() {
  const identity = useIdentity();
  const password = useSignal('');
  const name = useSignal('');
  const first = useRef<HTMLInputElement>(null);
  useEffect(() => first.current?.focus(), []);
  const waitS = useSecondsUntil(identity.notBeforeMs.value);
  // Once it has passed, how long to wait is no news any more.
  const waited = identity.notBeforeMs.value !== null && waitS === 0;
  const problem = waited ? null : identity.problem.value;
  const submit = async (event: Event) => {
    event.preventDefault();
    await identity.logIn(name.value.trim(), password.value);
    password.value = '';
  };
  return (
    <main class="login" data-testid="login">
      <form class="login-card" onSubmit={(event) => void submit(event)}>
        <h1 class="product">
          {appText.product} <span class="tagline">{appText.tagline}</span>
        </h1>
        {problem !== null && (
          <p class="message message-bad" role="alert" data-testid="login-problem">
            {sentence(problem)}
          </p>
        )}
        <label for="login-name">{appText.userName}</label>
        <input
          id="login-name"
          ref={first}
          type="text"
          autocomplete="username"
          autocapitalize="none"
          spellcheck={false}
          required
          data-testid="login-name"
          value={name.value}
          onInput={(event) => (name.value = event.currentTarget.value)}
        />
        <label for="login-password">{appText.password}</label>
        <input
          id="login-password"
          type="password"
          autocomplete="current-password"
          required
          data-testid="login-password"
          value={password.value}
          onInput={(event) => (password.value = event.currentTarget.value)}
        />
        <Button submit look="main" testId="log-in" disabled={identity.busy.value || waitS > 0}>
          {identity.busy.value ? appText.loggingIn : waitS > 0 ? appText.tryAgainIn(waitS) : appText.logIn}
        </Button>
      </form>
    </main>
  );
}

/** Whole seconds that are left until a time, counting down. */
function useSecondsUntil(timeMs: number | null): number {
  const [nowMs, setNowMs] = useState(Date.now());
  const left = timeMs === null ? 0 : Math.max(0, Math.ceil((timeMs - nowMs) / 1000));
  useEffect(() => {
    setNowMs(Date.now());
    if (timeMs === null) return;
    const timer = setInterval(() => {
      setNowMs(Date.now());
      if (Date.now() >= timeMs) clearInterval(timer);
    }, 250);
    return () => clearInterval(timer);
  }, [timeMs]);
  return left;
}
