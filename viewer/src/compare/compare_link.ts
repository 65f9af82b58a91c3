// SPDX-License-Identifier: Apache-2.0
import type {ViewState} from '../page/view_link';
import {CompareState, kUsualComparison} from './comparison';

/** What the address holds of a comparison; nothing without one. */
export function linkOfComparison({mode, left, right, split, unit, range}: CompareState): ViewState {
    if (mode === 'off') return {};
    if (mode === 'wipe') return {compare: mode, left, right, split};
    return {compare: mode, left, right, unit, range};
}

export function comparisonFromLink({compare, left, right, split, unit, range}: ViewState): CompareState {
    const usual = kUsualComparison;
    return {
        mode: compare === 'wipe' || compare === 'difference' ? compare : 'off',
        left: left ?? usual.left, right: right ?? usual.right, split: split ?? usual.split,
        unit: unit === 'percent' ? 'percent' : 'stops', range: range ?? usual.range,
    };
}
