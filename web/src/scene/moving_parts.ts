import type { ToolAction } from '../state/tool_action';
import type { Pose } from '../wire/messages';

const samePose = (a: Pose | null, b: Pose | null): boolean =>
  a === b ||
  (a !== null &&
    b !== null &&
    a.translationMm.every((value, i) => value === b.translationMm[i]) &&
    a.rotationXyzw.every((value, i) => value === b.rotationXyzw[i]));

const sameAction = (a: ToolAction | null, b: ToolAction | null): boolean =>
  a?.spindleRadS === b?.spindleRadS && a?.irrigating === b?.irrigating && a?.removedMm3 === b?.removedMm3;

/**
 * What was last drawn of what every message tells anew. A session that is paused, or a hand that rests, sends the same
 * sixty times a second, and needs no new picture.
 */
export class MovingParts {
  private readonly last: { tool?: Pose | null; bone?: Pose | null; action?: ToolAction | null; touching?: boolean } =
    {};

  /** Whatever comes next is new: reamer or bone are others. */
  forget(): void {
    for (const part of ['tool', 'bone', 'action', 'touching'] as const) delete this.last[part];
  }
  toolMoved(pose: Pose | null): boolean {
    const { tool } = this.last;
    this.last.tool = pose;
    return tool === undefined || !samePose(tool, pose);
  }
  boneMoved(pose: Pose | null): boolean {
    const { bone } = this.last;
    this.last.bone = pose;
    return bone === undefined || !samePose(bone, pose);
  }
  actionChanged(now: ToolAction | null): boolean {
    const { action } = this.last;
    this.last.action = now;
    return action === undefined || !sameAction(action, now);
  }
  touchingChanged(now: boolean): boolean {
    const { touching } = this.last;
    this.last.touching = now;
    return touching !== now;
  }
}
