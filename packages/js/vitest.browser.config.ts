// SPDX-License-Identifier: Apache-2.0
// Tests in Chromium with software rendering.
import {defineConfig} from 'vitest/config';

export default defineConfig({
    test: {include: ['browser_tests/**/*.test.ts'], fileParallelism: false, testTimeout: 300_000, hookTimeout: 300_000},
});
