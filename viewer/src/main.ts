import "./style.css";
import { showAlone } from "./alone";
import { LiveView } from "./live";
import { poseAt } from "./poses";

const host = document.getElementById("app") as HTMLElement;
const recording = document.getElementById("recording")?.textContent;

/** A handle for tests and for the curious: what is shown, and the poses as they are drawn. */
const handle: Record<string, unknown> = { poseAt };
Object.assign(window, { brisance: handle });

try {
  if (recording) {
    handle.viewer = await showAlone(host, recording);
  } else {
    const live = new LiveView(host);
    Object.assign(handle, { live, viewer: live.viewer });
  }
} catch (error) {
  host.replaceChildren();
  const sentence = `This page could not start: ${error instanceof Error ? error.message : String(error)}. It needs WebGL 2.`;
  host.append(Object.assign(document.createElement("p"), { className: "fatal", textContent: sentence }));
}
