// SPDX-License-Identifier: Apache-2.0
// Tests in Chromium against a real `tetralight serve`: one file at a time, software rendering.
import {defineConfig} from 'vitest/config';

export default defineConfig({
    test: {
        include: ['browser_tests/**/*.test.ts'],
        fileParallelism: false,
        testTimeout: 240_000,
        hookTimeout: 240_000,
    },
});
