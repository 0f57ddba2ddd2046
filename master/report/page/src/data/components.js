// Maps names to components.

/**
 * The longest component name that is a prefix of the full name, since systems are nested; null if there is none.
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

/** The same; if there is none, the part before the first dot. */
export const ownerOf = (name, components) => componentOf(name, components) ?? name.split(".")[0];

/** The name within its component. */
export const nameWithin = (name, components) => name.slice(ownerOf(name, components).length + 1) || name;
