// SPDX-License-Identifier: Apache-2.0
// Tests in Chromium against a real `tetralight serve`: one file at a time, software rendering.
import {defineConfig} from 'vitest/config';

import {kPatience} from './browser_tests/patience';

export default defineConfig({
    test: {
        include: ['browser_tests/**/*.test.ts'],
        fileParallelism: false,
        testTimeout: 2 * kPatience,
        hookTimeout: kPatience,
        expect: {poll: {timeout: kPatience}},
        retry: 1,  // a browser on a busy machine may break down once
    },
});
