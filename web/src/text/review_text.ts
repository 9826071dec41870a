/** Texts of the review page; loaded with it. */
import type { MapName } from '../wire/review_api';
import { duration } from './format';

const sideWords = { proud: 'too high', even: '', beyond: 'too deep' };

export const reviewText = {
  review: 'Review',
  reviewOf: (id: string) => `Review session ${id}`,
  loading: 'Opening the recording…',
  session: (id: string) => `Session ${id}`,
  facts: 'The session',
  first: 'Left',
  second: 'Right',
  pane: (number: number, id: string) => `Session ${number}: ${id}`,
  close: 'Close',
  closePane: (id: string) => `Close session ${id}`,
  theatre: 'Theatre',
  theatreHint: 'Reamed in theatre mode, without gauges or plan.',
  fault: (reason: string) => `It ended with a fault: ${reason}`,

  errors: {
    gone: {
      title: 'This session does not exist',
      text: 'It was deleted, or the address is wrong. Instructors and operators can restore it under Sessions, Deleted sessions.',
    },
    live: {
      title: 'This session is still running',
      text: 'You can review it after the end. Until then, watch it in the live view.',
    },
    damaged: {
      title: 'The recording cannot be shown',
      text: (reason: string) =>
        `It is damaged or was never written: ${reason} The known part of the score is still shown. For details, run “ream replay SESSION” on the server.`,
    },
    forbidden: {
      title: 'You have no access to this session',
      text: 'It belongs to someone else. Ask an instructor for a viewer link, or log in as its trainee.',
    },
    silent: {
      title: 'The simulator does not respond',
      text: 'The network is down, or the server is not running. Trying again automatically.',
    },
    other: {
      title: 'That did not work',
      text: (reason: string) => reason,
    },
  },
  tryAgain: 'Try again',
  toSessions: 'Go to sessions',
  toLive: 'Go to the live view',

  moment: 'Time',
  before: 'Before',
  after: 'After',
  beforeHint: 'The bone before reaming',
  afterHint: 'The bone at the end of the session',
  momentStatus: (depth: string, thrust: string, removed: string) =>
    `depth ${depth} mm · thrust ${thrust} N · removed ${removed} mm³`,
  events: (count: number) => `Events (${count})`,
  noEvents: 'No events.',
  previousEvent: 'Previous event',
  nextEvent: 'Next event',
  thrustChart: (most: string) => `Axial thrust over the whole session, up to ${most} N`,
  noTrace: (reason: string) => `The force curve could not be loaded: ${reason}`,
  noTraceForViewers: 'Viewer links do not show the force curve. Log in to see it.',
  annotation: 'Comment',
  annotationHint: 'Add a comment at this time',
  addAnnotation: 'Save comment',

  surface: 'Surface',
  mapName: { none: 'Bone', plan: 'Deviation', implant: 'Implant fit', wall: 'Wall' } as Record<
    MapName | 'none',
    string
  >,
  mapHint: {
    none: 'The bone at this time, without a map',
    plan: 'Distance of the reamed surface from the planned surface',
    implant: 'Distance of the reamed surface from the back of the implant in its best position',
    wall: 'Thickness of the bone behind the reamed surface',
  } as Record<MapName | 'none', string>,
  map: 'Map of the surface',
  mapCaption: {
    plan: 'Too high (under-reamed): bone remains that the plan removes. Too deep (over-reamed, hatched): cut deeper than planned.',
    implant: 'Too high: bone overlaps the implant. Too deep (hatched): a gap behind the implant.',
    wall: 'Thickness of the bone behind the reamed face, measured at right angles to the face.',
  } as Record<MapName, string>,
  mapMaking: (percent: string) => `Preparing the map: ${percent}`,
  mapAtEnd: 'Maps show the bone at the end of the session only.',
  scale: 'Scale',
  scaleName: { fine: 'Fine (0.1 mm)', report: 'As in the report (0.25 mm)', coarse: 'Coarse (0.5 mm)' },
  classWithin: (mm: string) => `within ${mm} mm`,
  classBetween: (from: string, to: string, side: 'proud' | 'even' | 'beyond') =>
    `${from} to ${to} mm ${sideWords[side]}`,
  classOver: (mm: string, side: 'proud' | 'even' | 'beyond') => `over ${mm} mm ${sideWords[side]}`,
  classWall: (fromMm: number, toMm: number) =>
    !Number.isFinite(fromMm)
      ? `up to ${String(toMm)} mm thick`
      : Number.isFinite(toMm)
        ? `${String(fromMm)} to ${String(toMm)} mm thick`
        : `over ${String(fromMm)} mm thick`,
  classUnknown: 'not compared',
  hatched: 'hatched',
  share: (percent: string) => `${percent}`,
  shareHint: 'Share of the compared points of the surface',
  outOfRange: (mm: string, percent: string) => `Values are capped at ${mm} mm (${percent} of the area).`,
  breach: 'Vault breach',
  breachNone: 'none; the implant’s pegs or keel stay within the cortex',
  breachBy: (mm: string) => `the implant’s pegs or keel perforate the cortex by ${mm} mm`,
  breachMissing: (why: string) => `not available: ${why}`,
  noMap: {
    silent: 'The map could not be loaded: the simulator does not respond. Choose it again later.',
    forbidden: 'Viewer links do not show maps. Log in to see them.',
    nothing: (reason: string) => `No map available: ${reason}. To get a map, plan the case before reaming.`,
    damaged: (reason: string) =>
      `No map, because the recording is damaged: ${reason} The undamaged part is still shown.`,
    other: (reason: string) => `The map failed: ${reason} Choose it again to retry.`,
    mismatch: 'The map does not fit the surface. Choose it again.',
  },
  deviationHere: (mm: string, side: 'proud' | 'even' | 'beyond') =>
    side === 'even' ? `${mm} mm` : `${mm} mm ${sideWords[side]}`,

  measure: 'Measure',
  measureHint: 'Click two points on the bone. Or rotate each to the middle with the arrow keys and press Enter.',
  measureFirst: 'Click a point on the bone, or rotate it to the middle of the picture and press Enter.',
  measureSecond: 'Click a second point.',
  measureMissed: 'There is no bone at this point.',
  measureClear: 'Clear',
  distance: 'Distance',
  depthOf: (number: number) => `Depth of point ${number}`,
  depthHint: 'Along the planned axis, from the planned entry into the bone',
  deeper: 'Depth difference',
  across: 'Distance across the axis',
  millimetres: (mm: string) => `${mm} mm`,
  mapAt: {
    plan: (number: number) => `Deviation from plan at point ${number}`,
    implant: (number: number) => `Implant fit at point ${number}`,
    wall: (number: number) => `Wall at point ${number}`,
  },

  score: 'Score',
  overall: 'Total score',
  points: (points: string) => `${points} of 100`,
  noPoints: 'No score',
  nextTime: 'Next time',
  noOutcome: 'No result: this rubric has no pass mark.',
  rubric: (name: string, version: number, passPoints: number | undefined) =>
    `Rubric “${name}”, version ${version}${passPoints === undefined ? '' : `; pass mark ${passPoints}`}`,
  measuredPercent: (percent: string) => `The score covers ${percent} of the rubric.`,
  scoreLoading: 'Loading the score…',
  noScore: (reason: string) => `The score could not be loaded: ${reason}`,
  countsForMark: 'Scored metrics',
  otherMetrics: (count: number) => `Other metrics (${count})`,
  missing: (count: number) => `Not available (${count})`,
  metricColumn: 'Metric',
  valueColumn: 'Value',
  pointsColumn: 'Points',
  verdict: { pass: 'good', warn: 'borderline', fail: 'bad' },
  noVerdict: 'no limits',
  critical: 'Critical criterion: decides the result, whatever the score',
  bandReport: 'No limits, not scored',
  bandLess: (pass: string, warn: string) =>
    pass === warn ? `good up to ${pass}, bad above` : `good up to ${pass}, borderline up to ${warn}, bad above`,
  bandMore: (pass: string, warn: string) =>
    pass === warn ? `good from ${pass} on, bad below` : `good from ${pass} on, borderline from ${warn} on, bad below`,
  bandBetween: (low: string, pass: string) => `good from ${low} to ${pass}, borderline elsewhere`,
  definition: 'Definition',
  unit: 'Unit',
  noUnit: 'none',
  band: 'Limits',
  source: 'Source',
  confidence: 'Confidence',
  evidence: {
    S: 'published source',
    M: 'common knowledge in the field',
    E: 'engineering judgement',
    T: 'tested for this project',
  },
  weight: 'Weight',
  weightOf: (weight: string, points: string) => `${weight}; ${points} points`,
  missingReason: 'Reason',
  units: {
    deg: '°',
    mm: 'mm',
    mm2: 'mm²',
    mm3: 'mm³',
    'N s': 'N·s',
  } as Record<string, string>,

  unitNames: {
    deg: 'degrees (°)',
    mm: 'millimetres (mm)',
    mm2: 'square millimetres (mm²)',
    mm3: 'cubic millimetres (mm³)',
    s: 'seconds (s)',
    N: 'newtons (N)',
    'N s': 'newton seconds (N·s)',
    'N/mm': 'newtons per millimetre (N/mm)',
    '%': 'percent (%)',
  } as Record<string, string>,

  files: 'Report and files',
  formats: {
    html: ['Report (HTML)', 'One page with pictures, maps and every metric with its source'],
    pdf: ['Report (PDF)', 'The same report for printing'],
    load: [
      'Report with loaded implant (PDF)',
      'Adds a page: the bone under a loaded implant, before and after reaming',
    ],
    csv: ['Trace (CSV)', 'Forces and poses, one row per millisecond'],
    parquet: ['Trace (Parquet)', 'The same for pandas, Polars, R'],
    stl: ['Bone (STL)', 'The reamed surface'],
    ply: ['Bone, implant, map (PLY)', 'Reamed surface and seated implant, coloured by deviation from the plan'],
    glb: ['Bone, implant, map (GLB)', 'The same for glTF viewers'],
  } as const,
  scoreFile: 'Score (JSON)',
  scoreFileHint: 'Every metric with definition, unit, source and limits',
  making: (percent: string) => `preparing, ${percent}`,
  ready: 'Download again',
  exportFailed: (what: string, reason: string) => `${what} could not be prepared: ${reason}`,
  verification: 'Verification',
  verificationHint:
    'This browser computes the bone again from every recorded movement. Forces, score and author are not checked.',
  verify: 'Verify here',
  verifying: (s: number) => `${duration(s)} computed and in agreement so far`,
  verified: (s: number) => `✓ ${duration(s)} of movements, computed again, leave exactly the recorded bone.`,
  partlyVerified: (s: number, all: number) =>
    `✓ ${duration(s)} of movements agree. The recording has ${duration(all)}; no bone was saved for its last moments.`,
  notAgreeing: {
    differs: (s: number) => `The recording contradicts itself. The bone agrees for the first ${duration(s)} only.`,
    damaged: (s: number) => `The file is damaged. The bone agrees for the first ${duration(s)}.`,
  },
  notVerified: {
    browser: 'This browser could not compute the bone. It needs WebAssembly, and memory for the whole bone.',
    connection: 'The files did not arrive. Check the connection, then verify again.',
  },
  verificationRefused: (reason: string) => `The session could not be verified: ${reason}`,
  filesForbidden: 'Viewer links do not offer files. Log in to download them.',
  shareHere: 'Share',
  linkHint: 'A link to this review for someone without an account',
  shareOpen: 'Login is off: anyone who can reach this server can open the address of this page.',
  copyAddress: 'Copy address',
  copied: 'Copied',
  notCopied: 'Copy it from the browser’s address bar',

  compare: 'Compare',
  compareWith: 'Compare with',
  compareNone: 'There is no other finished session on this case.',
  compareChoose: 'Choose a session…',
  compareSelf: '(this session)',
  sameCamera: 'Both are shown from the same viewpoint relative to the plan.',
  otherCase: 'The sessions are on different cases. Each is shown from the same viewpoint relative to its own plan.',

  keys: 'Keys',
  keyList: [
    ['K', 'play and pause'],
    [', and .', 'previous event, next event'],
    ['B', 'before and after'],
    ['D', 'bone, deviation, implant fit, wall'],
    ['E', 'measure; Enter at the middle of the picture'],
    ['T', 'CT slices'],
    ['V C X', 'surgeon’s view, cut-away, transparent'],
    ['1 2 3 [ ]', 'sections; move the last section'],
    ['Q', 'choose which of two sessions the keys control'],
    ['Esc', 'close the explanation of a metric'],
  ] as const,
  keysFor: (number: number) => `Keys K , . B D control session ${number}.`,
};
