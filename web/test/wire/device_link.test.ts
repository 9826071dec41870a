import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { DeviceLink, deviceLostAfterMs, deviceSilentAfterMs, type DeviceLinkState } from '../../src/wire/device_link';
import type { Feedback } from '../../src/wire/device_messages';
import { FakeDeviceSocket, feedback, welcome } from './fake_device_socket';

describe('DeviceLink', () => {
  let socket: FakeDeviceSocket;
  let link: DeviceLink;
  let state: DeviceLinkState | undefined;
  const heard: Feedback[] = [];

  beforeEach(() => {
    vi.useFakeTimers();
    socket = new FakeDeviceSocket();
    heard.length = 0;
    link = new DeviceLink({ socket, onState: (s) => (state = s), onFeedback: (f) => heard.push(f) });
    link.connect('ws://s1');
  });
  afterEach(() => {
    link.disconnect();
    vi.useRealTimers();
  });

  it('holds once the server answers', () => {
    expect(state?.kind).toBe('connecting');
    socket.handlers?.onReport(welcome());
    expect(state?.kind).toBe('connecting');
    socket.handlers?.onReport(feedback());
    expect(state?.kind).toBe('holding');
    expect(heard).toHaveLength(1);
  });

  it('says that it is silent, gives up, and tries again until it is back', () => {
    socket.handlers?.onReport(welcome());
    socket.handlers?.onReport(feedback());
    vi.advanceTimersByTime(deviceSilentAfterMs + 100);
    expect(state?.kind).toBe('silent');
    vi.advanceTimersByTime(deviceLostAfterMs);
    expect(socket.opened.length).toBeGreaterThan(1);
    socket.handlers?.onReport(feedback());
    expect(state?.kind).toBe('holding');
  });

  it('comes back by itself after a loss, with growing pauses', () => {
    socket.handlers?.onClosed(1006, '');
    expect(state?.kind).toBe('lost');
    vi.advanceTimersByTime(250);
    expect(socket.opened).toHaveLength(2);
    socket.handlers?.onClosed(1006, '');
    vi.advanceTimersByTime(250);
    expect(socket.opened).toHaveLength(2);
    vi.advanceTimersByTime(250);
    expect(socket.opened).toHaveLength(3);
    socket.handlers?.onReport(welcome());
    socket.handlers?.onReport(feedback());
    expect(state?.kind).toBe('holding');
  });

  it('does not come back when it is sent away', () => {
    socket.handlers?.onReport(welcome());
    socket.handlers?.onClosed(4001, 'another client has become the device of this session');
    expect(state).toEqual({ kind: 'ended', reason: 'another client has become the device of this session' });
    vi.advanceTimersByTime(60_000);
    expect(socket.opened).toHaveLength(1);
  });

  it('does not speak to a server of another revision', () => {
    socket.handlers?.onReport(welcome(2));
    expect(state?.kind).toBe('ended');
    expect(socket.closed).toBeGreaterThan(0);
  });

  it('stays away after it was disconnected', () => {
    socket.handlers?.onClosed(1006, '');
    link.disconnect();
    vi.advanceTimersByTime(60_000);
    expect(socket.opened).toHaveLength(1);
  });
});
