// Numbers as in signals.csv: the shortest text that reads back as the same number, without an exponent if that is no
// longer than with an exponent (std::to_chars of C++).

/** The shortest digits and the exponent of the first one: 0.00123 is { digits: "123", exponent: -3 }. */
function scientific(text) {
  const [mantissa, exponent] = text.split("e");
  return { digits: mantissa.replace(".", ""), exponent: Number(exponent) };
}

function withExponent({ digits, exponent }) {
  const mantissa = digits.length > 1 ? `${digits[0]}.${digits.slice(1)}` : digits;
  const power = String(Math.abs(exponent)).padStart(2, "0");
  return `${mantissa}e${exponent < 0 ? "-" : "+"}${power}`;
}

function plain({ digits, exponent }, magnitude) {
  if (exponent < 0) return `0.${"0".repeat(-exponent - 1)}${digits}`;
  if (digits.length > exponent + 1) return `${digits.slice(0, exponent + 1)}.${digits.slice(exponent + 1)}`;
  return BigInt(magnitude).toString();
}

function shortest(magnitude, parts) {
  const long = withExponent(parts);
  if (Math.abs(parts.exponent) > long.length) return long;
  const short = plain(parts, magnitude);
  return short.length <= long.length ? short : long;
}

/** With this number of digits after the first one; half-way cases are rounded to an even last digit. */
function rounded(magnitude, count) {
  const { digits, exponent } = scientific(magnitude.toExponential(60));
  const isInTheMiddle = /^50*$/.test(digits.slice(count + 1));
  if (isInTheMiddle && Number(digits[count]) % 2 === 0) return { digits: digits.slice(0, count + 1), exponent };
  return scientific(magnitude.toExponential(count));
}

/** The shortest text of a single-precision number has fewer digits than that of the double of the same value. */
function singleParts(magnitude) {
  for (let count = 0; count < 9; ++count) {
    const parts = rounded(magnitude, count);
    if (Math.fround(Number(withExponent(parts))) === magnitude) return parts;
  }
  return scientific(magnitude.toExponential());
}

/**
 * @param {number} value
 * @param {boolean} [single] whether it is a single-precision number
 */
export function numberText(value, single = false) {
  if (Number.isNaN(value)) return "nan";
  const sign = value < 0 || Object.is(value, -0) ? "-" : "";
  const magnitude = Math.abs(value);
  if (magnitude === Infinity) return `${sign}inf`;
  if (magnitude === 0) return `${sign}0`;
  const parts = single ? singleParts(magnitude) : scientific(magnitude.toExponential());
  return sign + shortest(magnitude, parts);
}

/** For display: four digits, with separated thousands. */
export function briefText(value) {
  if (!Number.isFinite(value)) return numberText(value);
  const magnitude = Math.abs(value);
  if (magnitude !== 0 && (magnitude < 1e-3 || magnitude >= 1e6)) return value.toPrecision(3).replace(/\.?0+e/, "e");
  return value.toLocaleString("en", { maximumSignificantDigits: magnitude >= 1000 ? 7 : 4 });
}
