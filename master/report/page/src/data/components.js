// Which component a name belongs to.

/**
 * The longest one that the full name begins with, since systems hold others; null where there is none.
 * @param {string} name
 * @param {Set<string>} components
 */
export function componentOf(name, components) {
  for (let end = name.lastIndexOf("."); end > 0; end = name.lastIndexOf(".", end - 1)) {
    const candidate = name.slice(0, end);
    if (components.has(candidate)) return candidate;
  }
  return null;
}

/** Likewise, but where there is none what stands before the first point. */
export const ownerOf = (name, components) => componentOf(name, components) ?? name.split(".")[0];

/** What a name is called within its component. */
export const nameWithin = (name, components) => name.slice(ownerOf(name, components).length + 1) || name;
