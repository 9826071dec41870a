/** Every text of the page, in one place. */
import type { SessionState } from './wire/messages';

export const words = {
  product: 'ream',
  tagline: 'Glenoid reaming',

  runDemo: 'Run demo',
  running: 'Reaming…',
  starting: 'Starting…',
  stop: 'Stop',

  state: {
    created: 'Ready',
    running: 'Reaming',
    paused: 'Paused',
    finished: 'Finished',
    stopped: 'Stopped',
    fault: 'Fault',
    interrupted: 'Interrupted',
    replaying: 'Replay',
  } satisfies Record<SessionState, string>,
  stateHint: {
    created: 'The bone before reaming.',
    running: 'The scripted hand is reaming.',
    paused: 'The session is paused.',
    finished: 'The demo has ended. This is the bone as it was left.',
    stopped: 'The session was stopped. This is the bone as it was left.',
    fault: 'The session ended with a fault; the hand was sent no force.',
    interrupted: 'The server ended in mid-session. What was recorded up to then is kept.',
    replaying: 'This is a recording.',
  } satisfies Record<SessionState, string>,

  stateUnknown: (state: string) => `What the session is doing is not known; when last heard of it was ${state}.`,

  replay: 'Replay',
  replayBadge: 'Replay – not live',
  linkReplay: 'Replay',
  backToLive: 'Back to live',
  replayOf: (id: string) => (id === '' ? 'Opening the recording' : `Recording of session ${id}`),
  recordedAs: (state: string) => `It ended as: ${state}.`,
  recordingDamaged: (how: string) => `Part of this recording is damaged and cannot be shown: ${how}.`,
  replayGone: 'The replay has ended. This is the simulator as it is now.',
  replaySession: (id: string) => `Replay session ${id}`,
  sessions: (count: number) => `Sessions (${count})`,
  noSessions: 'None yet.',
  playback: 'Playback',
  play: 'Play',
  rest: 'Pause',
  moment: 'Moment of the recording',
  momentOf: (position: string, duration: string) => `${position} of ${duration}`,
  speed: 'Speed',
  replayed: 'replay',
  mark: (kind: string) =>
    kind === 'annotation'
      ? 'Remark'
      : kind === 'resume'
        ? 'Resumed'
        : kind === 'reamer'
          ? 'Reamer changed'
          : kind === 'damaged'
            ? 'Recording damaged'
            : kind.charAt(0).toUpperCase() + kind.slice(1),

  linkConnecting: 'Connecting',
  linkLive: 'Live',
  linkSilent: 'No news',
  linkLost: 'Link lost',
  linkRefused: 'Wrong version',

  preparing: 'Preparing the bone…',
  loading: 'Loading the bone…',
  lostTitle: 'The link to the simulator is lost',
  silentTitle: 'The simulator has gone quiet',
  lastPicture: (clock: string) => `This is the last picture, from ${clock}. It is not live.`,
  neverTitle: 'The simulator is not ready yet',
  retryIn: (seconds: number) => `Trying again in ${seconds.toFixed(seconds < 1 ? 1 : 0)} s.`,
  retryNow: 'Trying again…',
  waiting: 'Waiting for it to answer.',
  refusedTitle: 'This page and the simulator do not match',
  refusedText: (page: number, server: number) =>
    `The page understands stream revision ${page}, the simulator sends ${server}. Reload the page.`,
  catchingUp: 'Connected again. Loading the bone as it is now…',

  noAnswer: 'The simulator does not answer.',
  unreadableAnswer: 'The simulator sent an answer that cannot be read.',
  answeredWith: (status: number) => `The simulator answered with an error (${status}).`,
  problem: 'That did not work',
  dismiss: 'Dismiss',
  fault: 'Fault',

  thrust: 'Axial thrust',
  thrustPlot: 'Axial thrust over the last 20 seconds of the session',
  thrustNow: (newtons: string) => `now ${newtons} N`,
  hand: 'At the hand',
  depth: 'Depth',
  depthOf: (planned: string) => `of ${planned} mm planned`,
  depthLeft: (mm: string) => `${mm} mm to go`,
  depthReached: 'Planned depth reached',
  depthPast: (mm: string) => `${mm} mm past the plan`,
  removed: 'Bone removed',
  feed: 'Feed',
  density: 'Bone density',
  cortical: 'Cortical share',
  spindle: 'Spindle',
  on: 'on',
  off: 'off',
  time: 'Session time',
  forceScale: 'Force scale',
  loop: 'Tick / p99',
  missed: 'Ticks missed',
  lostSamples: 'Samples lost',
  reamer: 'Reamer',
  notLive: 'not live',
  none: '–',

  results: 'Result',
  meanThrust: 'Mean thrust',
  peakThrust: 'Peak thrust',
  corticalVolume: 'Cortical bone',
  cancellousVolume: 'Cancellous bone',

  side: (side: string) => (side === 'left' ? 'Left shoulder' : side === 'right' ? 'Right shoulder' : 'Side unknown'),

  view: 'View',
  noWebGl: 'This page needs WebGL 2, which this browser does not offer.',
  viewPlan: 'Surgeon',
  viewAxis: 'Along axis',
  viewSide: 'From the side',
  showReamer: 'Reamer',
  sceneLabel:
    'Bone and reamer in three dimensions. Drag or use the arrow keys to turn, plus and minus to zoom, Home to reset.',
};
