// SPDX-License-Identifier: Apache-2.0
import {readFileSync} from 'node:fs';

import {expect, test} from 'vitest';

import {BakeKind, kOrders} from '../../src/bake/bake_orders';
import {describe, fieldsOf} from '../../src/bake/bake_presets';

const kKinds = Object.keys(kOrders) as BakeKind[];
const paths = Object.keys(JSON.parse(readFileSync(new URL('../../../server/openapi.json', import.meta.url), 'utf8')).paths);

test.each(kKinds)('%s are ordered at a path of the service', kind => {
    expect(paths).toContain(kOrders[kind].path);
});

test.each(kKinds)('presets of %s say what they set', kind => {
    expect(describe(kind, 'production')).toBe('For the result: the defaults of all fields.');
    for (const [key, value] of Object.entries(fieldsOf(kind, 'preview'))) {
        expect(describe(kind, 'preview')).toContain(`${key.replaceAll('_', ' ')} ${value}`);
    }
    expect(Object.keys(fieldsOf(kind, 'preview')).length).toBeGreaterThan(0);
});

test('production says the defaults of what a preview changes', () => {
    const defaults = new Map([['target_error', '1% with at most 64 samples, unless samples is given'], ['max_samples', '2'], ['seed', '0']]);
    expect(describe('volumes', 'production', defaults)).toBe(
        'For the result: the defaults of all fields (target error 1% with at most 64 samples).');
});
