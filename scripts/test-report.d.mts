/** What of vitest's JSON report is read. */
export interface TestReport {
  readonly testResults: readonly {
    readonly name: string;
    readonly status: string;
    readonly message: string;
    readonly assertionResults: readonly { readonly fullName: string; readonly status: string }[];
  }[];
}
export declare function readReport(file: string): TestReport | null;
export declare function failedFiles(report: TestReport): string[];
export declare function failuresIn(report: TestReport): string[];
export declare function passedCountIn(report: TestReport): number;
export declare function withSecondAttempt(first: TestReport, second: TestReport): TestReport;
