// SPDX-License-Identifier: Apache-2.0
/** How long a test waits for what must come, in milliseconds: bakes give way to all else on a busy machine. */
export const kPatience = 600_000;
