/** Whether tests that try a sample try all: scripts/test --full says so. */
export const fullTests = process.env.REAM_FULL_TESTS !== undefined;
