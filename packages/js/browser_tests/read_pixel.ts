// SPDX-License-Identifier: Apache-2.0

/** Bytes in the middle of what was drawn last, before the page shows it. */
export function readPixel(gl: WebGL2RenderingContext): number[] {
    const pixel = new Uint8Array(4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return [...pixel.subarray(0, 3)];
}

export function bytesOf(base64: string): Uint8Array {
    return Uint8Array.from(atob(base64), c => c.charCodeAt(0));
}
