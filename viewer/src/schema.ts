// The JSON schema of a scene, as far as controls need it.

export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  type?: string;
  title?: string;
  description?: string;
  default?: unknown;
  enum?: unknown[];
  const?: unknown;
  examples?: unknown[];
  anyOf?: Schema[];
  allOf?: Schema[];
  items?: Schema;
  prefixItems?: Schema[];
  properties?: Record<string, Schema>;
  required?: string[];
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
}

export type Kind =
  | { kind: "number"; whole: boolean; low?: number; high?: number }
  | { kind: "switch" }
  | { kind: "choice"; choices: string[] }
  | { kind: "text"; examples: string[]; numbers: boolean }
  | { kind: "vector"; length: number }
  | { kind: "table"; schema: Schema }
  | { kind: "tables"; schema: Schema }
  | { kind: "data" };

/** A schema with references followed, its description and default kept. */
export function resolved(schema: Schema, root: Schema): Schema {
  const reference = schema.$ref ?? (schema.allOf?.length === 1 ? schema.allOf[0]?.$ref : undefined);
  if (!reference) return schema;
  const target = root.$defs?.[reference.split("/").at(-1) ?? ""] ?? {};
  const { $ref: _, allOf: __, ...own } = schema;
  return { ...resolved(target, root), ...own };
}

/** Which control a schema asks for. */
export function kindOf(given: Schema, root: Schema): Kind {
  const schema = resolved(given, root);
  const ways = (schema.anyOf ?? []).map((way) => resolved(way, root)).filter((way) => way.type !== "null");
  if (ways.length === 1 && ways[0]) return kindOf({ ...ways[0], ...described(schema) }, root);
  if (ways.length > 1) {
    const texts = ways.flatMap((way) => way.enum ?? (way.const === undefined ? [] : [way.const]));
    const numbers = ways.some((way) => way.type === "number" || way.type === "integer");
    const plain = ways.every(
      (way) => way.enum || way.const !== undefined || /number|integer|string/.test(way.type ?? ""),
    );
    return plain ? { kind: "text", examples: texts.map(String), numbers } : { kind: "data" };
  }
  if (schema.enum) return { kind: "choice", choices: schema.enum.map(String) };
  if (schema.type === "boolean") return { kind: "switch" };
  if (schema.type === "number" || schema.type === "integer") {
    const low = schema.minimum ?? schema.exclusiveMinimum;
    const high = schema.maximum ?? schema.exclusiveMaximum;
    return {
      kind: "number",
      whole: schema.type === "integer",
      ...(low === undefined ? {} : { low }),
      ...(high === undefined ? {} : { high }),
    };
  }
  if (schema.type === "string") {
    return { kind: "text", examples: (schema.examples ?? []).map(String), numbers: false };
  }
  if (schema.type === "array") {
    const parts = schema.prefixItems?.map((part) => resolved(part, root));
    if (parts?.every((part) => part.type === "number")) return { kind: "vector", length: parts.length };
    const item = schema.items && resolved(schema.items, root);
    if (item?.properties) return { kind: "tables", schema: item };
  }
  if (schema.type === "object" && schema.properties) return { kind: "table", schema };
  return { kind: "data" };
}

function described({ description, default: standard, examples }: Schema): Schema {
  return {
    ...(description === undefined ? {} : { description }),
    ...(standard === undefined ? {} : { default: standard }),
    ...(examples === undefined ? {} : { examples }),
  };
}

/** The unit that a description names in square brackets, if any. */
export function unitOf(description = ""): string {
  return /\[([^\]]{1,16})\]/.exec(description)?.[1] ?? "";
}
