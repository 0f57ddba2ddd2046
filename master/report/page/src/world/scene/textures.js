// Textures that are in the file, decoded from its bytes: GLTFLoader would load them from addresses, of which the page
// allows none.
import { Texture } from "three";

async function decoded(parser, { bufferView, mimeType }) {
  if (bufferView === undefined) throw new Error("a texture is not in the file");
  const bytes = await parser.getDependency("bufferView", bufferView);
  const options = { premultiplyAlpha: "none", colorSpaceConversion: "none" };
  const texture = new Texture(await createImageBitmap(new Blob([bytes], { type: mimeType }), options));
  texture.needsUpdate = true;
  return texture;
}

/** A plugin of GLTFLoader. */
export const embeddedTextures = (parser) => ({
  name: "embedded_textures",
  loadTexture(index) {
    const { source } = parser.json.textures[index];
    parser.sourceCache[source] ??= decoded(parser, parser.json.images[source]);
    return parser.loadTextureImage(index, source, parser.textureLoader);
  },
});
