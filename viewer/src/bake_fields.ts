// SPDX-License-Identifier: Apache-2.0
// The settings of a bake, as `POST /v1/bakes` takes them, with their defaults in words.

export interface BakeField {
    key: string;
    label: string;
    kind: 'number' | 'integer' | 'share' | 'text' | 'flag' | 'vector' | 'list' | 'sky' | 'choice';
    default: string;
    hint: string;
    options?: string[];
}

export const kBakeSections: {title: string; fields: BakeField[]}[] = [
    {
        title: 'Quality', fields: [
            {key: 'samples', label: 'Samples', kind: 'integer', default: '1024',
             hint: 'Directions a probe, at first. Alone: neither more nor less.'},
            {key: 'target_error', label: 'Target error', kind: 'share', default: '0.005',
             hint: 'Samples of a probe double until its standard error is below this share: 0.05, or 5%.'},
            {key: 'max_samples', label: 'Most samples', kind: 'integer', default: '131072',
             hint: 'Directions a probe at most, then.'},
            {key: 'bounces', label: 'Bounces', kind: 'integer', default: '4',
             hint: 'Reflections that light may take; 0 is direct light only.'},
            {key: 'clamp', label: 'Clamp', kind: 'number', default: '0',
             hint: 'Largest radiance that a path may bring; 0 clamps nothing.'},
            {key: 'seed', label: 'Seed', kind: 'integer', default: '0', hint: 'Of the random numbers.'},
        ],
    },
    {
        title: 'Sun and sky', fields: [
            {key: 'sky', label: 'Sky', kind: 'sky', default: "the scene's",
             hint: 'Radiance: one number, three with commas, or the name of a stored sky.'},
            {key: 'sky_intensity', label: 'Sky intensity', kind: 'number', default: '1', hint: 'Factor on the sky.'},
            {key: 'sky_rotation', label: 'Sky rotation', kind: 'number', default: '0',
             hint: 'Degrees about +Y, counter-clockwise from above.'},
            {key: 'sun_direction', label: 'Sun direction', kind: 'vector', default: 'no sun is added',
             hint: 'Where its light goes, for example 0.3, -1, 0.2.'},
            {key: 'sun_irradiance', label: 'Sun irradiance', kind: 'vector', default: 'none',
             hint: 'On a surface that faces it, for example 8, 7.5, 6.5.'},
            {key: 'sun_angle', label: 'Sun diameter', kind: 'number', default: '0',
             hint: 'Degrees in the sky: soft shadows. The real one has 0.53.'},
            {key: 'sun_mode', label: 'Sun mode', kind: 'choice', default: 'mixed', options: ['mixed', 'baked'],
             hint: 'Probes hold its bounces (mixed), or its direct light too (baked).'},
        ],
    },
    {
        title: 'Light apart', fields: [
            {key: 'layers', label: 'Layers', kind: 'list', default: 'none',
             hint: 'With commas: sun, sky, emission, light:NAME, material:NAME, transfer. To dim them later.'},
            {key: 'mixed_lighting', label: 'Mixed lighting', kind: 'choice', default: 'indirect',
             options: ['indirect', 'shadowmask', 'subtractive'],
             hint: 'Whether probes also hold how much of up to four mixed lights they see.'},
            {key: 'albedo_boost', label: 'Albedo boost', kind: 'number', default: '1',
             hint: 'Albedo to the power of 1 / this: more light bounces.'},
            {key: 'max_albedo', label: 'Most albedo', kind: 'number', default: '1',
             hint: 'No surface reflects more than this.'},
        ],
    },
    {
        title: 'Probes', fields: [
            {key: 'weld', label: 'Weld', kind: 'number', default: '0.0001',
             hint: 'Join probes nearer than this share of the local spacing.'},
            {key: 'min_validity', label: 'Least validity', kind: 'number', default: '0.75',
             hint: 'Share of directions without back faces; a probe with less lies in geometry.'},
            {key: 'virtual_offset', label: 'Virtual offset', kind: 'number', default: '0.45',
             hint: 'How far such a probe may look for a place outside, as a share of the distance to its neighbor.'},
            {key: 'invalid_probes', label: 'Invalid probes', kind: 'choice', default: 'leave-out',
             options: ['leave-out', 'dilate', 'keep'], hint: 'What becomes of those that find none.'},
            {key: 'dering', label: 'Dering all', kind: 'flag', default: 'only groups that ask for it',
             hint: 'Remove ringing (negative irradiance) from all probes.'},
            {key: 'dering_window', label: 'Dering window', kind: 'choice', default: 'mildest',
             options: ['mildest', 'hann', 'lanczos'], hint: 'Mildest: each probe no more than it takes.'},
        ],
    },
];

const kLargest = Number.MAX_SAFE_INTEGER;

/** Nothing is no number, either. */
const numberOf = (word: string) => word.trim() === '' ? NaN : Number(word);

/** What a field's text means in JSON; nothing: the default. */
export function valueOf(field: BakeField, text: string): unknown {
    const words = text.trim();
    if (words === '') return undefined;
    const numbers = words.split(',').map(numberOf);
    const isNumeric = numbers.every(Number.isFinite);
    switch (field.kind) {
        case 'number':
        case 'integer':
            if (numbers.length !== 1 || !isNumeric) throw new Error(`${field.label}: "${words}" is no number`);
            if (field.kind === 'integer' && Math.abs(numbers[0]) > kLargest) {
                throw new Error(`${field.label}: ${words} is beyond ${kLargest}`);
            }
            return numbers[0];
        case 'share': {
            const share = numberOf(words.replace(/\s*%$/, '')) / (words.endsWith('%') ? 100 : 1);
            if (!Number.isFinite(share)) throw new Error(`${field.label}: "${words}" is no number`);
            return share;
        }
        case 'vector':
            if (numbers.length !== 3 || !isNumeric) throw new Error(`${field.label}: "${words}" is not three numbers`);
            return numbers;
        case 'sky':
            if (!isNumeric) return words;
            return numbers.length === 1 ? numbers[0] : numbers;
        case 'list':
            return words.split(',').map(word => word.trim()).filter(word => word !== '');
        case 'flag':
            return words === 'true';
        default:
            return words;
    }
}

const kKeys = kBakeSections.flatMap(section => section.fields.map(field => field.key));

/** The settings that an earlier bake was ordered with. */
export function settingsOf(request: Record<string, unknown>): Record<string, unknown> {
    return Object.fromEntries(Object.entries(request).filter(([key]) => kKeys.includes(key)));
}
