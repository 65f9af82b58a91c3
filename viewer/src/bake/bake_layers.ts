// SPDX-License-Identifier: Apache-2.0
// The layers that a bake can keep apart, so that the tab View has a slider for each.
import * as three from 'three';

import {element} from '../page/dom';
import type {SceneModel} from '../scene/scene_model';

export interface LayerChoice {
    layer: string;
    label: string;
    /** The scene has light of this kind. */
    isOffered: boolean;
}

/** A volume has at most 32 layers; this many lamps leave the panel readable. */
const kMostLamps = 6;

/** Sky, sun and emission, and each lamp by its name. Lights that share a name share a layer. */
export function layerChoices(model: {lights: three.Light[]; emitters: three.MeshLambertMaterial[]} | null): LayerChoice[] {
    const lights = model?.lights ?? [];
    const hasSun = lights.some(light => light instanceof three.DirectionalLight);
    const lamps = new Set(lights.filter(light => !(light instanceof three.DirectionalLight)).map(nameOf)
                              .filter(name => name !== '' && !name.includes(',')));
    return [
        {layer: 'sky', label: 'Light of the sky', isOffered: true},
        {layer: 'sun', label: 'Light of the sun', isOffered: model === null || hasSun},
        {layer: 'emission', label: 'Emission', isOffered: model === null || model.emitters.some(isLit)},
        ...[...lamps].slice(0, kMostLamps).map(name => ({layer: `light:${name}`, label: name, isOffered: true})),
    ];
}

const isLit = ({emissive, emissiveIntensity}: three.MeshLambertMaterial) =>
    emissiveIntensity * Math.max(emissive.r, emissive.g, emissive.b) > 0;

/** The name in the file: of the node, or else of the light. three changes some characters of its own names. */
function nameOf(light: three.Light): string {
    return String(light.userData.name ?? light.parent?.userData.name ?? light.name);
}

/** Also those that are baked as a whole, which `SceneModel.lights` leaves out. */
function lightsOf(root: three.Object3D): three.Light[] {
    const lights: three.Light[] = [];
    root.traverse(node => { if (node instanceof three.Light) lights.push(node); });
    return lights;
}

/** Check boxes of the layers of a scene; what the user chose stays while the scene does. */
export class LayerFields {
    readonly element = element('fieldset', {class: 'layers'});
    private readonly inputs = new Map<string, HTMLInputElement>();

    /** Shows the layers of a scene. */
    follow(model: SceneModel | null): void {
        this.inputs.clear();
        const rows = layerChoices(model === null ? null : {lights: lightsOf(model.root), emitters: model.emitters}).map(({layer, label, isOffered}) => {
            const input = element('input', {type: 'checkbox'});
            input.checked = isOffered;
            this.inputs.set(layer, input);
            return element('label', {class: 'check'}, input, label);
        });
        this.element.replaceChildren(
            element('legend', {}, 'Sliders after the bake'), element('div', {class: 'checks'}, ...rows),
            element('small', {}, 'The tab View can then dim each of these lights. Each takes 112 bytes per probe.'));
    }

    /** Checks the boxes of these layers alone. */
    choose(layers: readonly string[]): void {
        for (const [layer, input] of this.inputs) input.checked = layers.includes(layer);
    }

    has(layer: string): boolean {
        return this.inputs.has(layer);
    }

    get chosen(): string[] {
        return [...this.inputs].filter(([, input]) => input.checked).map(([layer]) => layer);
    }
}
