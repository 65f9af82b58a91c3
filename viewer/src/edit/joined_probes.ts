// SPDX-License-Identifier: Apache-2.0
// The tetrahedra of edited probes, which the server finds.
import type {Volume} from 'tetralight';

import {edgesOf} from '../light/cell_edges';
import {CellLines} from '../light/cell_lines';
import {readVolume} from '../light/volume';
import type {Alerts} from '../page/alerts';
import type {Api} from '../page/api';
import {Newest} from '../page/newest';
import * as groups from './groups';

export class JoinedProbes {
    readonly lines = new CellLines(0x9aa7b8);
    /** The newest probes that are joined, or null: there are none. */
    volume: Volume | null = null;
    /** Of the probes as they are now; null: the server still works, or there are none. */
    tetrahedra: number | null = null;
    private asked: groups.Groups | null = null;
    private readonly saved = new Set<string>();
    private readonly newest: Newest<groups.Groups, Volume | null>;
    private readonly listeners: (() => void)[] = [];

    constructor(private readonly api: Api, alerts: Alerts) {
        this.newest = new Newest(now => this.join(now), joined => {
            alerts.succeed('join');
            this.show(joined);
        }, error => alerts.report('join', error));
    }

    /** Called when other probes are joined. */
    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    ask(now: groups.Groups): void {
        if (now === this.asked) return;
        this.asked = now;
        this.tetrahedra = null;
        this.newest.ask(now);
    }

    /** What could not be joined, because there was no server. */
    askAgain(): void {
        if (this.tetrahedra === null && this.asked !== null && this.asked.length > 0) this.newest.ask(this.asked);
    }

    /** Groups with this text are stored on purpose: joining them leaves them there. */
    leave(text: string): void {
        this.saved.add(text);
    }

    /** The server keeps nothing of it but groups that were saved. */
    private async join(now: groups.Groups): Promise<Volume | null> {
        if (groups.countOf(now) === 0) return null;
        const text = groups.formatGroups(now);
        const kept = [await this.api.upload('groups', text)];
        const paths = [`/v1/groups/${kept[0].file.id}`];
        try {
            kept.push(await this.api.keep('/v1/tetrahedralize', {groups: [kept[0].file.id]}));
            paths.push(`/v1/volumes/${kept[1].file.id}`);
            return readVolume(await this.api.bytes(`${paths[1]}/file`), 'of these groups');
        } finally {
            const made = paths.filter((_, i) => kept[i].isNew && (i > 0 || !this.saved.has(text)));
            await Promise.all(made.map(path => this.api.remove(path).catch(() => {})));
        }
    }

    private show(joined: Volume | null): void {
        this.volume = joined;
        if (joined === null) {
            this.lines.clear();
        } else {
            const {exactPositions, cells, info: {innerCellCount}} = joined.data;
            this.lines.show(new Float32Array(exactPositions), edgesOf(cells, innerCellCount));
        }
        if (!this.newest.isWaiting) this.tetrahedra = joined?.data.info.innerCellCount ?? null;
        for (const listener of this.listeners) listener();
    }
}
