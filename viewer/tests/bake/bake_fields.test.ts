// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {bakeSections, settingsOf, textOf, valueOf} from '../../src/bake/bake_fields';
import type {OpenApi} from '../../src/page/open_api';

const three = {type: 'array', items: {type: 'number'}, minItems: 3, maxItems: 3};
const document: OpenApi = {components: {schemas: {BakeOrder: {properties: {
    scene: {type: 'string', 'x-group': 'Files', 'x-stored': 'scenes'},
    only_given_groups: {type: 'boolean', 'x-group': 'Files'},
    sky: {oneOf: [{type: 'number'}, three, {type: 'string'}], 'x-group': 'Added light', 'x-default': "the scene's"},
    sun_direction: {...three, 'x-group': 'Added light', 'x-default': 'no sun'},
    samples: {type: 'integer', 'x-group': 'Samples', 'x-default': '1024', 'x-unit': 'samples', description: 'How many'},
    target_error: {type: 'number', 'x-group': 'Samples', 'x-unit': 'fraction', default: 0.005},
    seed: {type: 'integer', 'x-group': 'Samples', default: 0},
    layers: {type: 'array', items: {type: 'string'}, 'x-group': 'Light transport', 'x-default': 'one layer'},
    dering: {type: 'boolean', 'x-group': 'Probes'},
    dering_window: {type: 'string', enum: ['mildest', 'hann'], 'x-group': 'Probes', default: 'mildest'},
    reuse: {type: 'string', 'x-group': 'Earlier bakes', 'x-stored': 'volumes'},
    priority: {type: 'integer'},
}}}}};
const sections = bakeSections(document);
const fields = sections.flatMap(section => section.fields);
const field = (key: string) => fields.find(one => one.key === key)!;

test('each setting of the schema has a field below its heading, but not those of files', () => {
    expect(sections.map(({title, isFirst, fields}) => [title, isFirst, fields.map(({key}) => key)])).toEqual([
        ['Samples', true, ['samples', 'target_error', 'seed']], ['Light transport', true, ['layers']],
        ['Added light', false, ['sky', 'sun_direction']], ['Probes', false, ['dering', 'dering_window']],
    ]);
});

test('kinds, labels, defaults and hints follow from the schema', () => {
    expect(fields.map(({kind}) => kind)).toEqual(
        ['integer', 'number', 'integer', 'list', 'sky', 'vector', 'flag', 'choice']);
    expect(field('samples')).toMatchObject(
        {label: 'Samples', default: '1024', hint: 'How many. Unit: samples.', isFraction: false});
    expect(field('target_error')).toMatchObject({label: 'Target error', default: '0.005', isFraction: true});
    expect(field('dering').default).toBe('no');
    expect(field('dering_window').options).toEqual(['mildest', 'hann']);
});

test('texts are read as numbers, vectors, lists and words', () => {
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

test('text that is not a number is refused with its label', () => {
    expect(() => valueOf(field('samples'), 'many')).toThrow('Samples: "many" is not a number');
    expect(() => valueOf(field('samples'), '5%')).toThrow('Samples');
    expect(() => valueOf(field('sun_direction'), '1,2')).toThrow('Sun direction');
    expect(() => valueOf(field('sun_direction'), '1,,2')).toThrow('Sun direction');
    expect(() => valueOf(field('target_error'), '%')).toThrow('Target error');
});

test('whole numbers that doubles cannot hold are refused', () => {
    expect(valueOf(field('seed'), '9007199254740991')).toBe(9007199254740991);
    expect(() => valueOf(field('seed'), '9007199254740993'))
        .toThrow('Seed: 9007199254740993 is larger than 9007199254740991');
    expect(() => valueOf(field('seed'), '-9007199254740992')).toThrow('Seed');
});

test('the settings of an earlier bake are its order without its files and names', () => {
    const order = {scene: 'court', groups: ['a'], only_given_groups: true, name: 'old', priority: 3,
                   reuse: 'older', samples: 64, sky: [1, 2, 3]};
    expect(settingsOf(fields, order)).toEqual({samples: 64, sky: [1, 2, 3]});
});

test('the text of a value is read as that value', () => {
    expect(textOf(undefined)).toBe('');
    expect(textOf(false)).toBe('');
    expect(valueOf(field('samples'), textOf(64))).toBe(64);
    expect(valueOf(field('layers'), textOf(['sun', 'light:desk lamp']))).toEqual(['sun', 'light:desk lamp']);
    expect(valueOf(field('sky'), textOf([0.1, 0.2, 0.3]))).toEqual([0.1, 0.2, 0.3]);
});
