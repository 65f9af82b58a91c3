// SPDX-License-Identifier: Apache-2.0
import {readFileSync} from 'node:fs';

import {expect, test} from 'vitest';

import {kBakeSections, settingsOf, valueOf} from '../src/bake_fields';

const fields = kBakeSections.flatMap(section => section.fields);
const field = (key: string) => fields.find(one => one.key === key)!;

test('the form has every setting that the service takes', () => {
    const openapi = JSON.parse(readFileSync('../server/openapi.json', 'utf8')) as {
        components: {schemas: {BakeOrder: {properties: Record<string, {enum?: string[]}>}}};
    };
    const {properties} = openapi.components.schemas.BakeOrder;
    const elsewhere = ['scene', 'name', 'groups', 'only_given_groups', 'priority', 'reuse'];
    expect([...fields.map(one => one.key), ...elsewhere].sort()).toEqual(Object.keys(properties).sort());
    for (const {key, options} of fields) expect(options).toEqual(properties[key].enum);
});

test('texts mean numbers, vectors, lists and words', () => {
    expect(valueOf(field('samples'), ' 256 ')).toBe(256);
    expect(valueOf(field('target_error'), '0.05')).toBe(0.05);
    expect(valueOf(field('target_error'), '5 %')).toBe(0.05);
    expect(valueOf(field('sun_direction'), '0.3, -1, 0.2')).toEqual([0.3, -1, 0.2]);
    expect(valueOf(field('sky'), '0.5')).toBe(0.5);
    expect(valueOf(field('sky'), '0.6,0.8,1')).toEqual([0.6, 0.8, 1]);
    expect(valueOf(field('sky'), 'dusk')).toBe('dusk');
    expect(valueOf(field('layers'), 'sun, sky,')).toEqual(['sun', 'sky']);
    expect(valueOf(field('dering'), 'true')).toBe(true);
    expect(valueOf(field('samples'), '  ')).toBeUndefined();
});

test('what is no number is refused with its label', () => {
    expect(() => valueOf(field('samples'), 'many')).toThrow('Samples: "many" is no number');
    expect(() => valueOf(field('sun_direction'), '1,2')).toThrow('Sun direction');
    expect(() => valueOf(field('sun_direction'), '1,,2')).toThrow('Sun direction');
    expect(() => valueOf(field('target_error'), '%')).toThrow('Target error');
});

test('whole numbers that doubles do not hold are refused', () => {
    expect(valueOf(field('seed'), '9007199254740991')).toBe(9007199254740991);
    expect(() => valueOf(field('seed'), '9007199254740993')).toThrow('Seed: 9007199254740993 is beyond 9007199254740991');
    expect(() => valueOf(field('seed'), '-9007199254740992')).toThrow('Seed');
});

test('the settings of an earlier bake are its order without what was baked', () => {
    const order = {scene: 'court', groups: ['a'], only_given_groups: true, name: 'old', priority: 3,
                   reuse: 'older', samples: 64, sky: [1, 2, 3]};
    expect(settingsOf(order)).toEqual({samples: 64, sky: [1, 2, 3]});
});
