import type { Role } from '../wire/rest_types';

/** What the page offers somebody; the server holds them to it. */
export interface Permissions {
  /** Make, steer, pause, reset and end sessions. */
  ream: boolean;
  /** Read cases. */
  readCases: boolean;
  editCases: boolean;
  /** See everybody's sessions, make viewer links, run studies. */
  teach: boolean;
  /** Take part in studies. */
  takePart: boolean;
  /** Users, deletion, unblinding. */
  operate: boolean;
  /** Delete sessions. */
  deleteSessions: boolean;
}

export function permissionsOf(role: Role | null): Permissions {
  const operate = role === 'operator';
  const teach = operate || role === 'instructor';
  const ream = teach || role === 'trainee';
  return { ream, readCases: ream, editCases: teach, teach, takePart: ream, operate, deleteSessions: teach };
}
