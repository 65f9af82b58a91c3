// SPDX-License-Identifier: Apache-2.0
// The settings of a bake as fields of a form, from the schema in /openapi.json.

import type {OpenApi, Schema} from '../page/open_api';

type FieldKind = 'number' | 'integer' | 'text' | 'flag' | 'vector' | 'list' | 'sky' | 'choice';

export interface BakeField {
    key: string;
    label: string;
    kind: FieldKind;
    /** The field also accepts "5%". */
    isFraction: boolean;
    default: string;
    hint: string;
    options?: string[];
    /** Numbers of a vector. */
    length?: number;
}

export interface BakeSection {
    title: string;
    isFirst: boolean;
    fields: BakeField[];
}

/** Sections that come first, and are open while settings are chosen one by one. */
const kFirstSections = ['Samples', 'Cubes', 'Light transport', 'Pages'];
/** The panel has controls of its own for the files of a bake. */
const kFileSection = 'Files';
/** Among the files, what is not a file: the objects of lightmaps, and the reflection probes to bake. */
const kFieldsOfFiles = ['only', 'probe', 'box', 'position', 'blend_distance'];

function kindOf(schema: Schema): FieldKind {
    if (schema.enum !== undefined) return 'choice';
    if (schema.oneOf !== undefined) return 'sky';
    switch (schema.type) {
        case 'boolean':
            return 'flag';
        case 'array':
            return schema.items?.type === 'number' ? 'vector' : 'list';
        case 'number':
        case 'integer':
            return schema.type;
        default:
            return 'text';
    }
}

function defaultOf(schema: Schema): string {
    if (schema['x-default'] !== undefined) return schema['x-default'];
    if (Array.isArray(schema.default)) return schema.default.join(', ');
    return schema.default === undefined ? 'no' : String(schema.default);
}

/** "target_error" → "Target error". */
function labelOf(key: string): string {
    const words = key.replaceAll('_', ' ');
    return words[0].toUpperCase() + words.slice(1);
}

function fieldOf(key: string, schema: Schema): BakeField {
    const unit = schema['x-unit'] === undefined ? '' : ` Unit: ${schema['x-unit']}.`;
    return {
        key, label: labelOf(key), kind: kindOf(schema), default: defaultOf(schema), options: schema.enum,
        length: schema.minItems,
        isFraction: schema['x-unit']?.startsWith('fraction') ?? false, hint: `${schema.description ?? ''}.${unit}`,
    };
}

/** The sections of the form for `POST /v1/bakes`, or of another order. */
export function bakeSections(document: OpenApi, order = 'BakeOrder'): BakeSection[] {
    const sections = new Map<string, BakeField[]>(kFirstSections.map(title => [title, []]));
    for (const [key, schema] of Object.entries(document.components.schemas[order].properties!)) {
        const title = schema['x-group'];
        const isOfPanel = title === kFileSection && !kFieldsOfFiles.includes(key);
        if (title === undefined || isOfPanel || schema['x-stored'] !== undefined) continue;
        sections.set(title, [...sections.get(title) ?? [], fieldOf(key, schema)]);
    }
    return [...sections].filter(([, fields]) => fields.length > 0)
        .map(([title, fields]) => ({title, fields, isFirst: kFirstSections.includes(title)}));
}

const kLargest = Number.MAX_SAFE_INTEGER;

/** NaN for text that is empty or not a number. */
const numberOf = (word: string) => word.trim() === '' ? NaN : Number(word);

function oneNumber(field: BakeField, words: string): number {
    const isPercent = field.isFraction && words.endsWith('%');
    const number = isPercent ? numberOf(words.replace(/\s*%$/, '')) / 100 : numberOf(words);
    if (!Number.isFinite(number)) throw new Error(`${field.label}: "${words}" is not a number`);
    if (field.kind === 'integer' && Math.abs(number) > kLargest) {
        throw new Error(`${field.label}: ${words} is larger than ${kLargest}`);
    }
    return number;
}

/** The JSON value of a field's text; nothing for the default. */
export function valueOf(field: BakeField, text: string): unknown {
    const words = text.trim();
    if (words === '') return undefined;
    const numbers = words.split(',').map(numberOf);
    const isNumeric = numbers.every(Number.isFinite);
    switch (field.kind) {
        case 'number':
        case 'integer':
            return oneNumber(field, words);
        case 'vector':
            if (numbers.length !== field.length || !isNumeric) {
                throw new Error(`${field.label}: "${words}" is not ${field.length} numbers with commas between them`);
            }
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

/** The settings of an earlier bake's order that the form has fields for. */
export function settingsOf(fields: Iterable<BakeField>, request: Record<string, unknown>): Record<string, unknown> {
    const keys = [...fields].map(field => field.key);
    return Object.fromEntries(Object.entries(request).filter(([key]) => keys.includes(key)));
}

/** The text of a field that `valueOf` reads as this value. */
export function textOf(value: unknown): string {
    if (value === undefined || value === null || value === false) return '';
    return Array.isArray(value) ? value.join(', ') : String(value);
}
