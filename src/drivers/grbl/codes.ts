/** What the numbers of errors and alarms mean. Those of grblHAL and FluidNC beyond Grbl's own differ. */

type Words = Readonly<Record<number, string>>;

const ERRORS: Words = {
  1: "a word begins with no letter",
  2: "a number is missing or damaged",
  3: "Grbl does not know that setting or command",
  4: "a value must not be negative",
  5: "homing is switched off ($22=0)",
  6: "a step pulse would be too short",
  7: "its stored settings were damaged, and it uses its defaults",
  8: "the machine must be idle for that",
  9: "the machine is locked after an alarm, or another program moves it by hand",
  10: "soft limits need homing ($22=1)",
  11: "the line is too long",
  12: "a setting asks for more steps a second than it can make",
  13: "its safety door is open: close it",
  14: "a line to store is too long",
  15: "the target is outside the machine's travel",
  16: "a manual move is written wrongly",
  17: "laser mode needs an output with PWM",
  20: "Grbl does not know that command",
  21: "two commands exclude each other",
  22: "no feed rate was set",
  23: "a whole number is needed",
  24: "two commands in the line use the axes",
  25: "a word is repeated",
  26: "the command needs an axis",
  27: "a line number is invalid",
  28: "a value that the command needs is missing",
  29: "Grbl does not have that coordinate system",
  30: "machine coordinates need G0 or G1",
  31: "an axis is given that the command does not use",
  32: "an arc has no axis in its plane",
  33: "the target is invalid",
  34: "the radius of an arc does not reach its end",
  35: "an arc has no centre",
  36: "a word is not used by any command",
  37: "a tool's length can only change along its own axis",
  38: "the number of a tool is too high",
};

/** Only those that a plot, a move or an unlocking can meet. */
const HAL_ERRORS: Words = {
  18: "its reset input is on",
  19: "a value must be positive",
  39: "a value is out of range",
  40: "it waits for another tool",
  41: "its spindle does not run",
  43: "the feed rate is too high",
  44: "the S value is out of its range",
  45: "a limit switch is pressed: move the carriage off it",
  46: "it must be homed first",
  49: "its self-test has failed",
  50: "its emergency stop is pressed: release it",
  51: "a motor driver reports a fault",
  52: "a setting's value is out of range",
  53: "that setting is not available",
  56: "its coordinate systems are locked",
  78: "access is denied",
  79: "that is not allowed after an emergency stop or a hit switch, until it is reset",
};
const FLUIDNC_ERRORS: Words = {
  18: "its configuration has no homing",
  39: "a value is out of range",
  40: "one of its inputs is on: release the button or switch",
  80: "a setting's number is out of range",
  81: "a setting's value is invalid",
  110: "it wants a password",
  120: "another interface is busy",
  152: "its configuration is faulty: see what it says when it starts",
};

const ALARMS: Words = {
  1: "a limit switch was hit",
  2: "the target is beyond the soft limits",
  3: "the machine was reset during a motion",
  4: "the probe was touched before it was used",
  5: "the probe has touched nothing",
  6: "the machine was reset while it sought its switches",
  7: "the door was opened while it sought its switches",
  8: "a switch was not released after homing",
  9:
    "a switch was not found. It may be unplugged, or the Grbl seeks one that the machine does not have, often that of Z: " +
    "take that axis out of its homing cycle",
  10: "the second switch of an axis with two motors was not found",
  // Of children that say only that they are a Grbl.
  11: "it must be homed first",
  12: "a limit switch is touched already: move the carriage off it",
  14: "it must be homed first",
};
const HAL_ALARMS: Words = {
  10: "its emergency stop was pressed",
  13: "its probe was touched",
  14: "its spindle does not reach its speed",
  15: ALARMS[10],
  16: "its self-test has failed",
  17: "a motor driver reports a fault",
  18: "its homing is set up wrongly",
};
const FLUIDNC_ALARMS: Words = {
  10: "its spindle reports a fault",
  11: "one of its inputs was on when it started: release the button or switch",
  12: "both switches of an axis are pressed",
  13: "its stop button was pressed",
  15: "its configuration is faulty: see what it says when it starts",
};

/** `version`: "Grbl 1.1h", "FluidNC 3.7.16" … */
export const errorWords = (code: number, version: string | null): string | undefined =>
  wordsOf(code, version, ERRORS, HAL_ERRORS, FLUIDNC_ERRORS);

export const alarmWords = (code: number, version: string | null): string | undefined =>
  wordsOf(code, version, ALARMS, HAL_ALARMS, FLUIDNC_ALARMS);

function wordsOf(code: number, version: string | null, own: Words, hal: Words, fluidNc: Words) {
  if (version?.startsWith("grblHAL")) return hal[code] ?? own[code];
  if (version?.startsWith("FluidNC")) return fluidNc[code] ?? own[code];
  return own[code];
}
