// SPDX-License-Identifier: Apache-2.0
// What the page shows, in its address: a link holds the view.

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
    hidden?: string[];
    color?: string;
    weights?: Record<string, number>;  // not negative
}

const round = (x: number) => Number(x.toFixed(3));

export function toLink(state: ViewState): string {
    const params = new URLSearchParams();
    for (const key of ['volume', 'scene', 'groups', 'reflections', 'tab', 'color'] as const) {
        const value = state[key];
        if (value !== undefined && value !== '') params.set(key, value);
    }
    for (const key of ['eye', 'target', 'object'] as const) {
        const value = state[key];
        if (value !== undefined) params.set(key, value.map(round).join(','));
    }
    if (state.exposure !== undefined) params.set('exposure', String(state.exposure));
    if (state.hidden !== undefined && state.hidden.length > 0) params.set('hidden', state.hidden.join(','));
    for (const [layer, weight] of Object.entries(state.weights ?? {})) params.set(`w.${layer}`, String(weight));
    return '#' + params.toString();
}

/** What cannot be read is left out. */
export function fromLink(link: string): ViewState {
    const params = new URLSearchParams(link.replace(/^#/, ''));
    const state: ViewState = {};
    for (const key of ['volume', 'scene', 'groups', 'reflections', 'tab', 'color'] as const) {
        const value = params.get(key);
        if (value !== null) state[key] = value;
    }
    for (const key of ['eye', 'target', 'object'] as const) {
        const numbers = (params.get(key) ?? '').split(',').map(Number);
        if (params.has(key) && numbers.length === 3 && numbers.every(Number.isFinite)) state[key] = numbers;
    }
    const exposure = Number(params.get('exposure'));
    if (exposure > 0 && Number.isFinite(exposure)) state.exposure = exposure;
    if (params.has('hidden')) state.hidden = params.get('hidden')!.split(',');
    for (const [key, value] of params) {
        const weight = Number(value);
        if (key.startsWith('w.') && weight >= 0 && weight < Infinity) (state.weights ??= {})[key.slice(2)] = weight;
    }
    return state;
}
