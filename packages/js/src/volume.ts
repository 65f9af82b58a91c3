// SPDX-License-Identifier: Apache-2.0
import {BakedLight, indirectMultiplier, readBakedLights} from './baked_lights.js';
import {answerBatch, BatchOptions, BatchOutputs, locateOffSurface} from './batch.js';
import {blendIrradiance, blendOcclusion, Precision, ProbeLight, readProbeLight} from './blend.js';
import {distantSun, unit} from './distant_light.js';
import {argumentError} from './error.js';
import {changedWeights, LayerWeights, recombine} from './layers.js';
import {ProbeHealth, readHealth} from './probe_health.js';
import {Query} from './query.js';
import {QueryOptions, readSettings} from './query_options.js';
import {checkDistantLight, LayeredLight, layerToRelight, movableSun, openIrradiance, relightLayer} from './relight.js';
import {FileData, SectionFile} from './section_file.js';
import {checkVector, kCoefficients, Vector} from './sh.js';
import {verify} from './verify.js';
import {kNone, kProbeFile, readVolumeData, VolumeData} from './volume_data.js';

/** A position as a blend: Σ weights[i] · probe probes[i] + ambient · the ambient light. All are ≥ 0, their sum is 1. */
export interface Location {
    /** `kNone`: the volume has no cells, or the position is not finite. A hint for the next query. */
    cell: number;
    /** Two to four probes; one at an end of a line, none without a cell. */
    probes: number[];
    weights: number[];
    ambient: number;
}

/** The light at a position. Weights know the walls between probes. */
export interface Light extends Location {
    /** 27 floats: nine RGB coefficients of irradiance. See `irradiance`. */
    sh: Float32Array;
    /** Four channels, 1 = lit. See `BakedLight.channel`. */
    occlusion: Float32Array;
}

/** A part of the light. */
export interface Layer {
    readonly name: string;
    /** 1 = as it was baked. */
    readonly weight: number;
}

export interface ReadOptions {
    /** Which of its two copies of the light is read, if a file has both. 'full' by default. */
    precision?: Precision;
}

/**
 * Opens a `.probes` file. An ordinary buffer is used in place and must not change; a shared or resizable one is copied.
 * Throws a `TetralightError` if any byte is wrong: its field is the section and the element.
 */
export function read(data: FileData, options: ReadOptions = {}): Volume {
    const {precision = 'full'} = options;
    if (precision !== 'full' && precision !== 'half') throw argumentError('precision', `is "${precision}"`);
    const volume = readVolumeData(new SectionFile(kProbeFile, data));
    verify(volume);
    return new Volume(volume, precision);
}

/** An open probe volume. */
export class Volume {
    private readonly query: Query;
    private probeLight: ProbeLight;
    private weights: number[];
    private layered: LayeredLight;
    private readonly movedLights = new Map<number, Partial<BakedLight>>();

    /** `data` must be verified. */
    constructor(readonly data: VolumeData, precision: Precision) {
        this.query = new Query(data);
        this.probeLight = readProbeLight(data, precision);
        this.weights = data.layers.map(layer => layer.weight);
        this.layered = data;
    }

    get probeCount(): number {
        return this.data.positions.length / 3;
    }

    get cellCount(): number {
        return this.data.cells.length / 8;
    }

    /** Light without a probe: that of the environment alone, 27 floats. */
    get ambient(): Float32Array {
        return this.probeLight.ambient;
    }

    /** Irradiance of all probes with the weights of now, 27 floats each; empty if the volume was never baked. */
    get irradiance(): Float32Array {
        return this.probeLight.irradiance;
    }

    get layers(): Layer[] {
        return this.data.layerNames.map((name, i) => ({name, weight: this.weights[i]}));
    }

    get lights(): BakedLight[] {
        return readBakedLights(this.data).map((light, i) => ({...light, ...this.movedLights.get(i)}));
    }

    /** One a probe; empty if it is not known: the volume was not baked. */
    get health(): ProbeHealth[] {
        return readHealth(this.data);
    }

    /** World position of a probe. Throws if there is none of this number. */
    position(probe: number): [number, number, number] {
        const {positions, info: {origin}} = this.data;
        if (!(Number.isInteger(probe) && probe >= 0 && probe < this.probeCount)) {
            throw argumentError('probe', `${probe} is not one of ${this.probeCount}`);
        }
        return [0, 1, 2].map(i => positions[3 * probe + i] + origin[i]) as [number, number, number];
    }

    /**
     * The cell of a world position, and the barycentric weights of its probes. The walk begins at `hint`, or at the cell
     * that the seed grid names; it always ends. Cells that share a face on which the position lies give the same light.
     */
    locate(position: Vector, hint = kNone, options: Pick<QueryOptions, 'outside' | 'fadeDistance'> = {}): Location {
        checkVector('position', position);
        this.query.locate(position[0], position[1], position[2], hint, readSettings(options));
        return this.location();
    }

    /** The light at a world position. */
    light(position: Vector, options: QueryOptions = {}): Light {
        const {query, data: {cells}, probeLight} = this;
        const settings = readSettings(options);
        const {hint = kNone, normal} = options;
        checkVector('position', position);
        if (normal) checkVector('normal', normal);
        if (normal) locateOffSurface(query, position, normal, hint, settings);
        else query.locate(position[0], position[1], position[2], hint, settings);
        query.hide(settings, settings.radius, settings.renderingLayers);
        const light = {...this.location(), sh: new Float32Array(kCoefficients), occlusion: new Float32Array(4)};
        blendIrradiance(cells, probeLight, query.cell, query.weights, query.ambient, light.sh, 0);
        blendOcclusion(cells, probeLight, query.cell, query.weights, query.ambient, light.occlusion, 0);
        return light;
    }

    /** `light` for many positions, three numbers each, into arrays of the caller. */
    batch(positions: ArrayLike<number>, outputs: BatchOutputs, options: BatchOptions = {}): void {
        answerBatch(this.data, this.probeLight, this.query, positions, outputs, options);
    }

    /**
     * Changes the weights of layers: `{lamp: 0, 'material:neon': 2}`. Others stay. Weights are factors on the light as it
     * was baked. Takes time in proportion to probes × layers.
     */
    setWeights(changes: LayerWeights): void {
        this.useLayers(this.layered, changedWeights(this.data.layerNames, this.weights, changes));
    }

    /**
     * Replaces the sky by another one: 48 numbers, 16 RGB coefficients of the radiance from each direction (`constantSky`, or a
     * projection of your own). The volume was baked with the layers sky and transfer. Weights stay.
     */
    relightSky(sky: Vector): void {
        checkDistantLight('sky', sky);
        const layer = layerToRelight(this.data, 'sky');
        this.useLayers(relightLayer(this.data, this.layered, layer, sky, sky, openIrradiance(sky)), this.weights);
    }

    /**
     * Moves the sun, so that it shines in `direction` with `irradiance`, RGB, on a surface that faces it. `lights` follow, and
     * lose the channel of the sun: the occlusion of probes is that of the old direction. The volume was baked with the layers
     * sun, which has one sun, and transfer.
     */
    relightSun(direction: Vector, irradiance: Vector): void {
        const index = movableSun(this.data);
        checkVector('irradiance', irradiance);
        if (!(irradiance[0] >= 0 && irradiance[1] >= 0 && irradiance[2] >= 0)) {
            throw argumentError('irradiance', `is (${Array.from(irradiance).join(', ')}); 0 or more is possible`);
        }
        const sun = distantSun(direction, irradiance);
        checkDistantLight('irradiance', sun);
        const layer = layerToRelight(this.data, 'sun');
        const bounced = sun.map(value => value * indirectMultiplier(this.data, index));
        const isBaked = this.lights[index].mode === 'baked';
        const {ambient} = this.layered.layers[layer];
        this.useLayers(relightLayer(this.data, this.layered, layer, isBaked ? sun : undefined, bounced, ambient), this.weights);
        this.movedLights.set(index, {direction: unit(direction), intensity: [irradiance[0], irradiance[1], irradiance[2]],
                                     channel: undefined});
    }

    private useLayers(layered: LayeredLight, weights: number[]): void {
        this.probeLight = recombine(layered, weights, this.probeLight.occlusion);
        this.layered = layered;
        this.weights = weights;
    }

    private location(): Location {
        const {query, data: {cells}} = this;
        const location: Location = {cell: query.cell, probes: [], weights: [], ambient: query.ambient};
        for (let i = 0; i < 4 && query.cell !== kNone; ++i) {
            const probe = cells[8 * query.cell + i];
            if (probe === kNone) continue;
            location.probes.push(probe);
            location.weights.push(query.weights[i]);
        }
        return location;
    }
}
