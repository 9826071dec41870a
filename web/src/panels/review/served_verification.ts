import type { VerificationSources } from '../../state/review/session_verification';
import type { ReviewApi } from '../../wire/review_api';
import { verifyBy } from '../../twin/verify';

/** A session of a server, whose causes it has made. */
export function servedVerification(review: Pick<ReviewApi, 'exported'>, id: string): VerificationSources {
  const here = (address: string) => new URL(address, document.baseURI).href;
  const start = () => new Worker(new URL('../../twin/verification_worker.ts', import.meta.url), { type: 'module' });
  return {
    causes: async (onProgress) => here(await review.exported(id, 'causes', onProgress)),
    verify: (causes, onTicks, signal) => verifyBy(start, { causes, module: here('ream-twin.wasm') }, onTicks, signal),
  };
}
