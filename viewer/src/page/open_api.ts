// SPDX-License-Identifier: Apache-2.0
// The orders that the service accepts: /openapi.json.

/** What the page reads of a JSON Schema. */
export interface Schema {
    type?: string;
    enum?: string[];
    oneOf?: Schema[];
    items?: Schema;
    minItems?: number;
    maxItems?: number;
    minimum?: number;
    exclusiveMinimum?: number;
    maximum?: number;
    default?: unknown;
    description?: string;
    properties?: Record<string, Schema>;
    'x-default'?: string;  // in words
    'x-unit'?: string;
    'x-group'?: string;    // heading
    'x-stored'?: string;   // the kind of stored files that it refers to
}

export interface OpenApi {
    components: {schemas: Record<string, Schema>};
}
