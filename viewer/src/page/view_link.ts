// SPDX-License-Identifier: Apache-2.0
// What the page shows, in its address: a link holds the view.

import {kMostMeters} from './dom';

export interface ViewState {
    volume?: string;
    scene?: string;
    groups?: string;
    reflections?: string;
    tab?: string;
    eye?: number[];
    target?: number[];
    object?: number[];
    exposure?: number;
    stops?: number;  // of it, above what was metered
    tone?: string;
    hidden?: string[];
    shown?: string[];  // of what is not shown at first
    color?: string;
    compare?: string;  // wipe or difference
    left?: string;
    right?: string;
    split?: number;  // 0 to 1
    unit?: string;
    range?: number;
    weights?: Record<string, number>;  // not negative
}

const kWords = ['volume', 'scene', 'groups', 'reflections', 'tab', 'color', 'tone', 'compare', 'left', 'right', 'unit'] as const;

const round = (x: number) => Number(x.toFixed(3));

export function toLink(state: ViewState): string {
    const params = new URLSearchParams();
    for (const key of kWords) {
        const value = state[key];
        if (value !== undefined && value !== '') params.set(key, value);
    }
    for (const key of ['eye', 'target', 'object'] as const) {
        const value = state[key];
        if (value !== undefined) params.set(key, value.map(round).join(','));
    }
    for (const key of ['split', 'range'] as const) if (state[key] !== undefined) params.set(key, String(round(state[key])));
    if (state.exposure !== undefined) params.set('exposure', String(state.exposure));
    if (state.stops !== undefined && state.stops !== 0) params.set('stops', String(state.stops));
    for (const key of ['hidden', 'shown'] as const) {
        const parts = state[key] ?? [];
        if (parts.length > 0) params.set(key, parts.join(','));
    }
    for (const [layer, weight] of Object.entries(state.weights ?? {})) params.set(`w.${layer}`, String(weight));
    return '#' + params.toString();
}

/** A link may say anything: larger numbers than these are of no view, and light must stay within half floats. */
const kMost = {meters: kMostMeters, weight: 1e4, exposure: 1e9, stops: 30};

/** What cannot be read or is too large is left out. */
export function fromLink(link: string): ViewState {
    const params = new URLSearchParams(link.replace(/^#/, ''));
    const state: ViewState = {};
    for (const key of kWords) {
        const value = params.get(key);
        if (value !== null) state[key] = value;
    }
    for (const key of ['eye', 'target', 'object'] as const) {
        const numbers = (params.get(key) ?? '').split(',').map(Number);
        if (params.has(key) && numbers.length === 3 && numbers.every(x => Math.abs(x) <= kMost.meters)) state[key] = numbers;
    }
    const split = Number(params.get('split') ?? NaN);
    if (split >= 0 && split <= 1) state.split = split;
    const range = Number(params.get('range'));
    if (range > 0 && Number.isFinite(range)) state.range = range;
    const exposure = Number(params.get('exposure'));
    if (exposure >= 1 / kMost.exposure && exposure <= kMost.exposure) state.exposure = exposure;
    const stops = Number(params.get('stops') ?? 0);
    if (stops !== 0 && Math.abs(stops) <= kMost.stops) state.stops = stops;
    for (const key of ['hidden', 'shown'] as const) {
        if (params.has(key)) state[key] = params.get(key)!.split(',');
    }
    for (const [key, value] of params) {
        const weight = Number(value);
        if (key.startsWith('w.') && weight >= 0 && weight <= kMost.weight) (state.weights ??= {})[key.slice(2)] = weight;
    }
    return state;
}
