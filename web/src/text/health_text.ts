/** Texts of the simulator's health: one state with a sentence of advice, the same on every page. */
export const healthText = {
  state: {
    ok: 'Simulation: OK',
    slow: 'Simulation: running slow',
    lost: 'Simulation: connection lost',
  },
  advice: {
    server: 'The server is too busy. Close other programs on it.',
    network: 'The network is slow. Use a cable if you can.',
    picture: 'This computer draws slowly. Close other programs.',
    stream: 'Nothing arrives from the server. Check the network.',
    hand: 'The server does not respond to your hand. Check the network.',
    version: 'Page and server do not match. Reload the page.',
  },
  strip: 'Simulation, sound and CT',
};
