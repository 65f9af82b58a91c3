// SPDX-License-Identifier: Apache-2.0
// Settings of a bake that go together.
import type {BakeKind} from './bake_orders';

export type Preset = 'preview' | 'production' | 'custom';

type Fields = Record<string, string>;

/** Production is what the service does by default: its target errors are those of docs/bake.md and docs/lightmaps.md. */
const kFields: Record<BakeKind, Record<'preview' | 'production', Fields>> = {
    volumes: {preview: {target_error: '5%', max_samples: '4096'}, production: {}},
    lightmaps: {preview: {texels_per_meter: '4', target_error: '20%', max_samples: '1024'}, production: {}},
    reflections: {preview: {cube_size: '64', samples: '32'}, production: {}},
};

/** The texts of the fields that a preset fills; all others are empty. */
export function fieldsOf(kind: BakeKind, preset: 'preview' | 'production'): Fields {
    return kFields[kind][preset];
}

/** Of a default in words, what holds here: "0.5% with …, unless samples is given" → "0.5% with …". */
const shortDefault = (words: string) => words.replace(/, unless .*/, '');

/** What a preset is for and what it sets. `defaults`: of the fields of the service, by their keys. */
export function describe(kind: BakeKind, preset: Preset, defaults: ReadonlyMap<string, string> = new Map()): string {
    if (preset === 'custom') return 'The fields below, as they are.';
    const list = (fields: Fields) => Object.entries(fields).map(([key, value]) => `${key.replaceAll('_', ' ')} ${value}`).join(', ');
    if (preset === 'preview') return `For looking at: ${list(fieldsOf(kind, preset))}.`;
    // The default of max_samples depends on other fields; that of target_error says it.
    const known = Object.keys(fieldsOf(kind, 'preview')).filter(key => key !== 'max_samples' && defaults.has(key));
    const words = list(Object.fromEntries(known.map(key => [key, shortDefault(defaults.get(key)!)])));
    return `For the result: the defaults of all fields${words === '' ? '' : ` (${words})`}.`;
}
