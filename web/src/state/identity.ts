import { batch, computed, signal } from '@preact/signals';

import type { LoginApi } from '../wire/login_api';
import { ApiError, credentials, messageOf } from '../wire/rest';
import { appText } from '../text/app_text';
import { sentence } from '../text/format';
import { permissionsOf } from './permissions';
import type { Login } from '../wire/rest_types';

/**
 * - checking: the server has not said yet who this is; `problem` says when it does not answer
 * - unknown: somebody must log in
 * - known: a user, a viewer by link, or anybody on a server without users
 */
export type IdentityPhase = 'checking' | 'unknown' | 'known';

const retryAfterMs = 2000;

/** Who uses the page. */
export class Identity {
  readonly phase = signal<IdentityPhase>('checking');
  readonly visitor = signal<Login | null>(null);
  /** Words about why the page asks for a login, or why it was refused. */
  readonly problem = signal<string | null>(null);
  /** A request is under way. */
  readonly busy = signal(false);
  /** Before this time the server takes no further try, ms. */
  readonly notBeforeMs = signal<number | null>(null);

  readonly may = computed(() =>
    permissionsOf(this.phase.value === 'known' ? (this.visitor.value?.role ?? null) : null),
  );
  /** Whether the server has users; without them nobody logs in or out. */
  readonly hasUsers = computed(() => this.visitor.value?.login_needed === true);
  readonly userId = computed(() => this.visitor.value?.user?.id ?? null);
  readonly name = computed(() => this.visitor.value?.user?.display_name || this.visitor.value?.user?.name || null);

  /** Who used the page before the login ended. */
  private before: Login | null = null;

  constructor(
    private readonly api: LoginApi,
    /** Somebody else uses the page from here on: what it knows is not for them. */
    private readonly onOther: () => void,
  ) {
    credentials.onRefused = () => this.end(this.endedText());
    credentials.renew = () => this.renew();
  }

  /** Finds out who this is, by the secret of a viewer link where there is one. Ends when the server has answered. */
  async find(linkSecret: string | null): Promise<void> {
    for (;;) {
      try {
        let visitor = await this.api.whoAmI();
        this.problem.value = null;
        const needed = visitor.login_needed && (visitor.role === null || visitor.role === 'viewer');
        if (linkSecret !== null && needed) visitor = await this.enterByLink(linkSecret, visitor);
        return this.take(visitor);
      } catch (error) {
        this.problem.value = messageOf(error);
        await new Promise((resolve) => setTimeout(resolve, retryAfterMs));
      }
    }
  }

  async logIn(name: string, password: string): Promise<void> {
    await this.attempt(async () => this.take(await this.api.logIn(name, password)));
  }

  async logOut(): Promise<void> {
    await this.attempt(async () => {
      await this.api.logOut();
      this.end(appText.loggedOut);
    });
  }

  /** The secret of a viewer link that came while the page was open. */
  async useLink(secret: string): Promise<void> {
    if (this.may.value.ream) return;
    await this.attempt(async () => this.take(await this.api.useLink(secret)));
    if (this.problem.value !== null) this.problem.value = refusedLink(this.problem.value);
  }

  /** The login has ended, by whosever hand. */
  end(reason: string): void {
    if (this.phase.value !== 'known') return;
    credentials.csrfToken = null;
    batch(() => {
      this.before = this.visitor.value;
      this.visitor.value = null;
      this.problem.value = reason;
      this.phase.value = 'unknown';
    });
  }

  private endedText(): string {
    if (!this.hasUsers.peek()) return appText.loginNeededNow;
    return this.visitor.peek()?.role === 'viewer' ? appText.linkEnded : appText.loginEnded;
  }

  /** Refused, the visitor is who they were. */
  private async enterByLink(secret: string, visitor: Login): Promise<Login> {
    try {
      return await this.api.useLink(secret);
    } catch (error) {
      if (!(error instanceof ApiError) || error.status === 0) throw error;
      if (visitor.role !== null) return visitor;
      this.problem.value = refusedLink(error.message);
      return visitor;
    }
  }

  private take(visitor: Login): void {
    const known = !visitor.login_needed || visitor.role !== null;
    const other = known && this.before !== null && !isSame(this.before, visitor);
    credentials.csrfToken = visitor.csrf_token;
    batch(() => {
      this.visitor.value = visitor;
      this.notBeforeMs.value = null;
      if (known || this.phase.value === 'known') this.problem.value = null;
      this.phase.value = known ? 'known' : 'unknown';
    });
    if (other) this.onOther();
  }

  /** True when the token was another: then the same call may succeed. */
  private async renew(): Promise<boolean> {
    const token = credentials.csrfToken;
    const present = this.visitor.value;
    const visitor = await this.api.whoAmI().catch(() => null);
    if (visitor === null || present === null) return false;
    if (!isSame(present, visitor)) {
      this.before = present;
      this.take(visitor);
      return false;
    }
    credentials.csrfToken = visitor.csrf_token;
    return visitor.csrf_token !== token;
  }

  private async attempt(action: () => Promise<void>): Promise<void> {
    this.busy.value = true;
    this.problem.value = null;
    try {
      await action();
    } catch (error) {
      const waitS = error instanceof ApiError ? error.retryAfterS : null;
      batch(() => {
        this.problem.value = messageOf(error);
        this.notBeforeMs.value = waitS === null ? null : Date.now() + waitS * 1000;
      });
    } finally {
      this.busy.value = false;
    }
  }
}

function refusedLink(reason: string): string {
  return `${appText.linkRefusedText} ${sentence(reason)}`;
}

function isSame(a: Login, b: Login): boolean {
  return a.role === b.role && a.user?.id === b.user?.id && a.only_session === b.only_session;
}
