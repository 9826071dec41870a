import { effect } from '@preact/signals';

import { BoneScene } from '../../scene/scene';
import { Api } from '../../wire/api';
import type { Replay } from '../../wire/rest_types';
import { WorkerStreamSocket } from '../../wire/stream_socket';
import { ReplayPlayer } from '../review/replay_player';
import { Store } from '../store';
import { toolAction } from '../tool_action';

/** A recording that a rater watches, without anything that says whose it is. */
export class RatedReplay {
  readonly store = new Store();
  readonly scene = new BoneScene();
  readonly player: ReplayPlayer;
  private readonly socket = new WorkerStreamSocket(this.scene.inSoftware);
  private readonly stops: (() => void)[] = [];

  constructor(
    readonly key: string,
    open: () => Promise<Replay>,
    origin: string,
  ) {
    const { scene, store } = this;
    const api = new Api(origin);
    this.player = new ReplayPlayer(
      key,
      store,
      {
        openReplay: open,
        replay: (id) => api.replay(id),
        changePlayback: (id, change) => api.changePlayback(id, change),
        streamUrl: (id) => api.streamUrl(id),
      },
      this.socket,
      scene,
    );
    this.stops.push(
      effect(() => scene.setToolPose(store.telemetry.value?.worldFromTool ?? null)),
      effect(() => scene.setToolAction(toolAction(store.telemetry.value, store.upToDate.value))),
      effect(() => scene.setTouching(store.touching.value)),
      effect(() => scene.setBonePose(store.telemetry.value?.worldFromBoneRest ?? null)),
    );
  }

  start(): void {
    this.player.start();
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.player.stop();
    this.scene.dispose();
    this.socket.dispose();
  }
}
