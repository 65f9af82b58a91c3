// SPDX-License-Identifier: Apache-2.0
// The canvas: renderer, camera, and a picture whenever something changed.
import * as three from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {kFov} from '../scene/first_view';
import {viewAfterKey} from './camera_keys';
import {meteredExposure} from './exposure';
import {measureLight} from './meter';
import {Pace} from './pace';
import {ShadowChanges} from './shadow_changes';
import {Sky} from './sky';
import {SmoothPicture} from './smooth_picture';

const kStillMilliseconds = 150;

/** Draws in another way than `render`. */
export interface Painter {
    /** A picture. */
    draw(): void;
    /** What is metered. */
    drawLight(): void;
}

export class Stage {
    readonly renderer: three.WebGLRenderer;
    readonly scene = new three.Scene();
    readonly sky = new Sky();
    readonly camera = new three.PerspectiveCamera(kFov, 1, 0.05, 2000);
    readonly controls: OrbitControls;
    readonly canvas: HTMLCanvasElement;
    /** Called when there is another exposure. */
    exposed = () => {};
    painter: Painter | null = null;
    /** The exposure is metered again when the camera has moved. */
    isAutomatic = false;
    /** Called after each picture. */
    readonly drawn: (() => void)[] = [];
    /** Of the resolution of the newest picture. */
    scale = 1;
    private isDue = false;
    private readonly pace = new Pace();
    private readonly smooth: SmoothPicture;
    private readonly shadows = new ShadowChanges();
    private hasOldShadows = false;
    private stillTimer: ReturnType<typeof setTimeout> | undefined;
    private isLoading = false;
    private metered = 1;
    private isExposed = false;

    constructor(readonly parent: HTMLElement) {
        this.renderer = new three.WebGLRenderer({antialias: false});
        this.smooth = new SmoothPicture(this.renderer);
        this.canvas = this.renderer.domElement;
        this.canvas.tabIndex = 0;
        this.canvas.setAttribute('role', 'application');
        this.canvas.setAttribute('aria-label', 'The scene in 3D. Arrow keys rotate, with Shift they ' +
            'move, plus and minus come nearer and go away. The question mark lists all keys.');
        parent.append(this.canvas);
        this.renderer.toneMapping = three.NeutralToneMapping;
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.autoUpdate = false;
        this.renderer.shadowMap.type = three.PCFShadowMap;
        this.sky.radiance.set(0x11151c);
        this.scene.add(this.sky.mesh);
        this.camera.position.set(12, 9, 16);
        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.zoomToCursor = true;
        this.controls.mouseButtons = {LEFT: three.MOUSE.ROTATE, MIDDLE: three.MOUSE.PAN, RIGHT: three.MOUSE.PAN};
        this.controls.addEventListener('change', () => this.draw());
        this.controls.addEventListener('end', () => { if (this.isAutomatic) void this.exposeItself(); });
        this.canvas.addEventListener('keydown', event => this.key(event));
        new ResizeObserver(() => this.resize()).observe(parent);
        this.resize();
    }

    /** Draws soon; many calls are one picture. */
    draw(): void {
        if (this.isDue) return;
        this.isDue = true;
        requestAnimationFrame(() => {
            if (this.isDue) this.drawInTime();  // else it was drawn meanwhile
        });
    }

    /** Draws at full resolution, antialiased. */
    drawNow(): void {
        this.drawAt(1);
    }

    /** The view as PNG, at full resolution. */
    picture(use: (picture: Blob) => void): void {
        this.drawNow();
        this.canvas.toBlob(picture => { if (picture !== null) use(picture); });  // before the browser clears what was drawn
    }

    /** Draws at the resolution that the machine draws in time for the next picture; the full picture follows. */
    private drawInTime(): void {
        const {scale} = this.pace;
        const start = performance.now();
        const count = this.renderer.info.programs?.length;
        this.drawAt(scale);
        const isCompiling = count !== this.renderer.info.programs?.length;
        void this.finished().then(() => {
            if (!isCompiling) this.pace.took(performance.now() - start, scale);
        });
        clearTimeout(this.stillTimer);
        if (scale < 1 && !this.isLoading) this.stillTimer = setTimeout(() => this.drawNow(), kStillMilliseconds);
    }

    private drawAt(scale: number): void {
        this.isDue = false;
        if (scale === 1) clearTimeout(this.stillTimer);
        if (scale !== this.scale) {
            this.scale = scale;
            this.fit();
        }
        this.followShadows(scale);
        const draw = () => this.painter === null ? this.render() : this.painter.draw();
        if (scale === 1) this.smooth.draw(draw);
        else draw();
        for (const listener of this.drawn) listener();
    }

    /** Decides whether the next picture draws the shadow maps again. */
    private followShadows(scale: number): void {
        const change = this.shadows.follow(this.scene);
        this.hasOldShadows ||= change !== 'none';
        // Shadows that only move may wait for the full picture.
        const {shadowMap} = this.renderer;
        shadowMap.needsUpdate = change === 'others' || (this.hasOldShadows && scale === 1);
        if (shadowMap.needsUpdate) this.hasOldShadows = false;
    }

    /** Draws the scene once, as it is lit now. */
    render(): void {
        this.renderer.render(this.scene, this.camera);
    }

    /** Resolves when all that was drawn is drawn. */
    private async finished(): Promise<void> {
        const gl = this.renderer.getContext() as WebGL2RenderingContext;
        const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        if (sync === null) return;  // the context is lost
        gl.flush();
        while (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise(later => setTimeout(later, 2));
        gl.deleteSync(sync);
    }

    /** Shows what has arrived so far in coarse pictures, until the work ends. */
    async whileLoading(work: () => Promise<void>): Promise<void> {
        this.isLoading = true;
        clearTimeout(this.stillTimer);
        try {
            await work();
        } finally {
            this.isLoading = false;
            this.drawNow();
        }
    }

    set exposure(exposure: number) {
        this.renderer.toneMappingExposure = exposure;
        this.draw();
    }

    get exposure(): number {
        return this.renderer.toneMappingExposure;
    }

    /** How much brighter than metered, in stops. */
    get stops(): number {
        return Math.log2(this.exposure / this.metered);
    }

    set stops(stops: number) {
        this.exposure = this.metered * 2 ** stops;
    }

    /** Shows an exposure that was chosen `stops` above one that was metered. */
    expose(exposure: number, stops = 0): void {
        this.isExposed = true;
        this.metered = exposure / 2 ** stops;
        this.exposure = exposure;
        this.exposed();
    }

    /** An exposure for pictures before the first that is metered or chosen. */
    guess(exposure: number | null): void {
        if (!this.isExposed && exposure !== null) this.exposure = exposure;
    }

    /** Meters this view; false, and nothing else, if it is black. The stops that were chosen stay, unless others are given. */
    async exposeItself(stops = this.isExposed ? this.stops : 0): Promise<boolean> {
        if (this.isDue && !document.hidden) await new Promise(requestAnimationFrame);  // the picture comes first
        const metered = meteredExposure(await this.light());
        if (metered !== null) this.expose(metered * 2 ** stops, stops);
        return metered !== null;
    }

    /** The light of the view without marks, RGBA. */
    light(): Promise<Float32Array> {
        return measureLight(this.renderer, this.scene, () => {
            this.followShadows(1);
            if (this.painter === null) this.render();
            else this.painter.drawLight();
        });
    }

    set toneMapping(toneMapping: three.ToneMapping) {
        this.renderer.toneMapping = toneMapping;
        this.exposed();
        this.draw();
    }

    get toneMapping(): three.ToneMapping {
        return this.renderer.toneMapping;
    }

    look(from: readonly number[], at: readonly number[]): void {
        this.camera.position.fromArray(from as number[]);
        this.controls.target.fromArray(at as number[]);
        this.controls.update();
        this.draw();
    }

    /** Looks at a box as a whole. */
    lookAtAll(box: three.Box3): void {
        const sphere = box.getBoundingSphere(new three.Sphere());
        const direction = new three.Vector3(0.55, 0.5, 0.8).normalize();
        const from = sphere.center.clone().addScaledVector(direction, 1.9 * sphere.radius);
        this.camera.far = Math.max(100, 20 * sphere.radius);
        this.camera.near = this.camera.far / 20000;
        this.camera.updateProjectionMatrix();
        this.look(from.toArray(), sphere.center.toArray());
    }

    /** Looks at a sphere from where the camera is, so that it fills a part of the picture's height or width. */
    frame({center, radius}: three.Sphere, share: number): void {
        const {camera, controls} = this;
        const half = Math.tan(three.MathUtils.degToRad(camera.fov / 2)) * Math.min(1, camera.aspect);
        const away = camera.position.clone().sub(controls.target)
                         .setLength(Math.max(4 * camera.near, radius / Math.sin(Math.atan(half * share))));
        this.look(center.clone().add(away).toArray(), center.toArray());
        this.endMove();
    }

    /** As after a drag: the address, and automatic exposure, follow the camera. */
    endMove(): void {
        this.controls.dispatchEvent({type: 'end'});
    }

    /** A ray through a place of the page. */
    rayAt(x: number, y: number): three.Raycaster {
        const box = this.canvas.getBoundingClientRect();
        const place = new three.Vector2(2 * (x - box.left) / box.width - 1,
                                        1 - 2 * (y - box.top) / box.height);
        const caster = new three.Raycaster();
        caster.setFromCamera(place, this.camera);
        return caster;
    }

    /** Where a position of the world is in the page. */
    pageFrom(position: three.Vector3): {x: number; y: number; isInFront: boolean} {
        const box = this.canvas.getBoundingClientRect();
        const p = position.clone().project(this.camera);
        return {x: box.left + (p.x + 1) / 2 * box.width, y: box.top + (1 - p.y) / 2 * box.height,
                isInFront: p.z < 1};
    }

    private resize(): void {
        const {clientWidth: width, clientHeight: height} = this.parent;
        if (width === 0 || height === 0) return;
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.fit();
        this.drawAt(this.scale);
    }

    /** Gives the canvas the size of its place and the resolution of now. */
    private fit(): void {
        const {clientWidth: width, clientHeight: height} = this.parent;
        this.renderer.setPixelRatio(this.scale * Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height);
    }

    private key(event: KeyboardEvent): void {
        const view = viewAfterKey(event, this.camera, this.controls.target);
        if (view === null) return;
        event.preventDefault();
        this.look(view.eye, view.target);
        this.endMove();
    }
}
