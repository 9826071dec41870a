import { type EyeOnPlan, eyeFromPlan, eyeOnPlan, isSameEye } from './shared_eye';
import type { BoneScene } from './scene';

type SharedScene = Pick<BoneScene, 'planFrame' | 'eye' | 'setEye'>;

/** One camera for several pictures: whichever is turned, all others are seen from there. */
export class SharedCamera {
  private readonly scenes = new Set<SharedScene>();
  /** Those that have been seen from where the others are. */
  private readonly joined = new WeakSet<SharedScene>();
  private eye: EyeOnPlan | null = null;

  add(scene: SharedScene): void {
    this.scenes.add(scene);
  }
  remove(scene: SharedScene): void {
    this.scenes.delete(scene);
    if (this.scenes.size === 0) this.eye = null;
  }

  /** To be called after every frame. */
  onDrawn(scene: SharedScene): void {
    const plan = scene.planFrame;
    if (plan === null || !this.scenes.has(scene)) return;
    const first = !this.joined.has(scene);
    this.joined.add(scene);
    if (first && this.eye !== null) return scene.setEye(eyeFromPlan(this.eye, plan));
    const now = eyeOnPlan(scene.eye(), plan);
    if (this.eye !== null && isSameEye(now, this.eye)) return;
    this.eye = now;
    for (const other of this.scenes)
      if (other !== scene && other.planFrame !== null) other.setEye(eyeFromPlan(now, other.planFrame));
  }
}
